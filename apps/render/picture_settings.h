// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/memory_budget.h"

#include <pcl6d/visualization/map_cloud.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Settings of `picture`. */
struct PictureSettings {
  std::string run; ///< folder of a run
  MemoryOption memory;
  std::string output;             ///< file or folder; empty: pictures/ in the run
  std::vector<std::string> views; ///< names; empty: every view suited to the run
  std::optional<PointColour> colour;
  std::optional<ColourMap> colour_map;
  Background background = Background::kDark;
  bool transparent = false;
  std::optional<int> width;  ///< [px]
  std::optional<int> height; ///< [px]
  std::size_t points = 4000000;
  std::optional<double> slice_height; ///< [m] in the world
  double slice_thickness = 0.3;       ///< [m]
  std::optional<int> scan;            ///< index NNN
  std::size_t viewpoint = 1;
  std::optional<double> azimuth;   ///< [rad]
  std::optional<double> elevation; ///< [rad]
  std::string models;              ///< folder of meshes; may be empty
  std::string title;               ///< empty: describes the run
};

/** \return false: --help or --version was given, and the program is to end
 * \throws UsageError, boost::program_options::error the arguments break a rule */
bool
parsePictureSettings(const std::vector<std::string>& arguments,
                     PictureSettings& settings);

} // namespace pcl6d::app
