// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/command_line.h"
#include "slam6d/settings.h"

#include <string>

namespace pcl6d::app {

/** Values that the command line knows in another form than the library. */
struct OptionWords {
  std::string format = "auto";
  std::string interpolation = "linear";
  std::string metascan = "all";
  std::string metric = toString(Slam6DOptions().metric);
  std::string minimiser = "quaternion";
  std::string plane_minimiser = "helix";
  std::string search = toString(Slam6DOptions().search);
  std::string robust = toString(Slam6DOptions().robust);
  std::string initial_guess = "auto";
  std::string loop_closing = toString(Slam6DOptions().loop_closing);
  std::string relaxation = toString(*Slam6DOptions().relaxation);
  std::string links = toString(Slam6DOptions().links);
  AutoDouble min_range, max_range, voxel, max_distance, max_distance_start;
  int last = -1;
  int threads = 0;
};

/** \brief Declares all options of pcl_slam6d; parsing fills settings and words. */
void
describeOptions(CommandLine& line, Settings& settings, OptionWords& words);

} // namespace pcl6d::app
