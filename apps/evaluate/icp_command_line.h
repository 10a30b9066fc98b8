// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/command_line.h"
#include "evaluate/icp_settings.h"

#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Values that the command line of `icp` knows in another form than the library. */
struct RawIcpSettings {
  std::string format = "auto";
  std::string guess;
  std::string robust = "none";
  AutoDouble min_range, max_range, voxel, max_distance, max_distance_start;
  AutoDouble offset_xy, offset_yaw, sigma_position, sigma_orientation;
  std::vector<std::string> metrics, minimisers, plane_minimisers, searches;
  bool all_combinations = false;
  int threads = 0;
};

/** \return the text above the options */
std::string
icpUsage();

/** \brief Describes all options, with their defaults. */
void
describeIcp(CommandLine& line, IcpSettings& settings, RawIcpSettings& raw);

} // namespace pcl6d::app
