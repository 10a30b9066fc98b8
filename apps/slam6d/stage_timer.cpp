// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/stage_timer.h"

#include <sys/resource.h>

namespace pcl6d::app {

StageTimer::StageTimer(const std::string& name, std::vector<RunResult::Stage>& stages)
: name_(name), stages_(stages), start_(std::chrono::steady_clock::now())
{}

StageTimer::~StageTimer()
{
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  stages_.push_back({name_, spent.count(), usage.ru_maxrss / 1024.0});
}

} // namespace pcl6d::app
