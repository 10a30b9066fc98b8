// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/interrupt.h"

#include <pcl6d/common/progress.h>

#include <chrono>
#include <optional>
#include <string>

namespace pcl6d::app {

/** \brief How fast a stage goes: the mean of the last seconds, where what is past counts
 * the less the longer ago it was. */
class StepRate {
public:
  using Clock = std::chrono::steady_clock;

  /** \brief So many steps of the stage are done at a time; the first call begins. */
  void
  update(std::size_t done, Clock::time_point now);

  /** \return steps per second; none before a second has passed and a step been seen */
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

/** \brief Shows the progress of a run on stderr: on a terminal a bar for each stage, with
 * rate and time left, that redraws itself in the columns which the terminal has at the
 * time; elsewhere (also TERM=dumb) a plain line per quarter of a stage; nothing when quiet.
 * It has no colours. */
class ProgressBar {
public:
  explicit ProgressBar(bool quiet);
  /** \brief Ends an unfinished line, so that what follows starts on its own. */
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar&
  operator=(const ProgressBar&) = delete;

  void
  show(const Progress& progress);

  /** \brief Prints a line of its own in place of the bar, which is then drawn below it;
   * not when quiet. */
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
  std::string bar_; ///< what stands in the terminal's last line
  Progress state_;  ///< of the stage that is shown
  StepRate rate_;
  StepRate::Clock::time_point last_;  ///< report, or the construction
  StepRate::Clock::time_point began_; ///< the stage: when the one before it ended
  StepRate::Clock::time_point drawn_; ///< the last time
  int quarter_ = -1;                  ///< last one printed, where there is no terminal
};

/** \brief What watched() throws. */
struct Interrupted {};

/** \return a callback for the library that shows how far it is, and stops it by throwing
 * Interrupted once a signal came in; keeps references to both */
ProgressCallback
watched(ProgressBar& bar, const Interrupt& interrupt);

/** \return the same without showing anything */
ProgressCallback
watched(const Interrupt& interrupt);

} // namespace pcl6d::app
