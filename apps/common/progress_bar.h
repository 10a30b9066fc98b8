// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/progress.h>

#include <string>

namespace pcl6d::app {

/** \brief Shows the progress of a run on stderr: a bar that redraws itself on a
 * terminal, one plain line per quarter of a stage otherwise, nothing when quiet. */
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

  /** \brief Prints a line of its own between two states of the bar; not when quiet. */
  void
  say(const std::string& line);

  /** \brief Prints `warning: line`, also when quiet. */
  void
  warn(const std::string& line);

private:
  void
  endLine();

  bool quiet_;
  bool terminal_;
  bool line_open_ = false;
  std::string stage_;
  int shown_ = -1; ///< last percent on a terminal, last quarter otherwise
};

} // namespace pcl6d::app
