// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/interrupt.h"

#include <pcl6d/common/progress.h>

#include <chrono>
#include <optional>
#include <string>

namespace pcl6d::app {

/** \brief Speed of a stage: mean over the last seconds, with weights that decay with age. */
class StepRate {
public:
  using Clock = std::chrono::steady_clock;

  /** \brief Sets the number of finished steps at a time; the first call starts the clock. */
  void
  update(std::size_t done, Clock::time_point now);

  /** \return steps per second; no value before one second and one step */
  std::optional<double>
  perSecond() const;

private:
  std::optional<Clock::time_point> last_;
  std::size_t done_ = 0;
  double steps_ = 0;   ///< both weighted
  double seconds_ = 0; ///< weighted
  double watched_ = 0; ///< [s] since the first call
};

/** \return "48 s", "3 min 20 s", "2 h 5 min" */
std::string
durationText(double seconds);

/** \brief Shows the progress of a run on stderr: on a terminal a bar for each stage,
 * with rate and time left, redrawn to the current width of the terminal; elsewhere (also
 * TERM=dumb) a plain line per quarter of a stage; no output when quiet. No colours. */
class ProgressBar {
public:
  explicit ProgressBar(bool quiet);
  /** \brief Ends an unfinished line, so that further output starts on a new line. */
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar&
  operator=(const ProgressBar&) = delete;

  void
  show(const Progress& progress);

  /** \brief Prints a line in place of the bar and redraws the bar below; no output when
   * quiet. */
  void
  say(const std::string& line);

  /** \brief Prints `warning: line`, also when quiet. */
  void
  warn(const std::string& line);

private:
  void
  begin(const std::string& stage);
  void
  end();
  void
  print(const std::string& line);
  void
  draw(const std::string& estimate);
  std::string
  timeLeft() const;

  bool quiet_;
  bool terminal_;
  std::string bar_; ///< last line of the terminal
  Progress state_;  ///< of the stage shown
  StepRate rate_;
  StepRate::Clock::time_point last_;  ///< report, or the construction
  StepRate::Clock::time_point began_; ///< start of the stage: end of the stage before
  StepRate::Clock::time_point drawn_; ///< the last time
  int quarter_ = -1;                  ///< last quarter printed, without a terminal
};

/** \brief What watched() throws. */
struct Interrupted {};

/** \return a callback for the library that shows the progress, and throws Interrupted
 * after a signal; keeps references to both arguments */
ProgressCallback
watched(ProgressBar& bar, const Interrupt& interrupt);

/** \return a callback as above, but without display */
ProgressCallback
watched(const Interrupt& interrupt);

} // namespace pcl6d::app
