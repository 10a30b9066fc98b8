// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/error_statistics.h>

#include <nlohmann/json.hpp>

namespace pcl6d::app {

using Json = nlohmann::ordered_json;

inline Json
statisticsJson(const ErrorStatistics& errors)
{
  return {{"rms", errors.rms},
          {"mean", errors.mean},
          {"median", errors.median},
          {"max", errors.max}};
}

} // namespace pcl6d::app
