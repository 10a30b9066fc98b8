// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/run_result.h>

#include <chrono>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Adds a stage with time and memory to a list at the end of its scope. */
class StageTimer {
public:
  StageTimer(const std::string& name, std::vector<RunResult::Stage>& stages);
  ~StageTimer();
  StageTimer(const StageTimer&) = delete;
  StageTimer&
  operator=(const StageTimer&) = delete;

private:
  std::string name_;
  std::vector<RunResult::Stage>& stages_;
  std::chrono::steady_clock::time_point start_;
};

} // namespace pcl6d::app
