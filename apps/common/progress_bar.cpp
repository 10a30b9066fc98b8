// SPDX-License-Identifier: BSD-3-Clause
#include "common/progress_bar.h"

#include <iostream>
#include <unistd.h>

namespace pcl6d::app {

ProgressBar::ProgressBar(bool quiet)
: quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1)
{}

ProgressBar::~ProgressBar()
{
  endLine();
}

void
ProgressBar::endLine()
{
  if (line_open_)
    std::cerr << '\n';
  line_open_ = false;
}

void
ProgressBar::say(const std::string& line)
{
  if (quiet_)
    return;
  endLine();
  std::cerr << line << '\n';
}

void
ProgressBar::warn(const std::string& line)
{
  endLine();
  std::cerr << "warning: " << line << '\n';
}

void
ProgressBar::show(const Progress& progress)
{
  if (quiet_ || progress.total == 0)
    return;
  if (progress.stage != stage_) {
    endLine();
    stage_ = progress.stage;
    shown_ = -1;
  }
  const int steps = terminal_ ? 100 : 4;
  const int state = static_cast<int>(steps * progress.done / progress.total);
  if (state == shown_)
    return;
  shown_ = state;
  const std::string count =
      std::to_string(progress.done) + "/" + std::to_string(progress.total);
  if (!terminal_) {
    std::cerr << stage_ << ' ' << count << '\n';
    return;
  }
  constexpr int kWidth = 40;
  const int filled = kWidth * state / steps;
  std::cerr << '\r' << stage_ << " [" << std::string(filled, '#')
            << std::string(kWidth - filled, '.') << "] " << count << ' ' << std::flush;
  line_open_ = true;
  if (progress.done == progress.total)
    endLine();
}

} // namespace pcl6d::app
