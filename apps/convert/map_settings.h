// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/memory_budget.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Kinds of maps, by the extension of the output. */
enum class MapKind {
  kOctree,    ///< .bt, .ot: OctoMap
  kGrid,      ///< .yaml: grid map of ROS
  kHeights,   ///< .tif, .tiff: GeoTIFF
  kTrajectory ///< .mcap: recording
};

/** \brief A range of heights above the floor [m]. */
struct HeightRange {
  double from = 0, to = 0;
};

/** \brief The command line of `convert map`, interpreted. */
struct MapSettings {
  std::string run;
  std::string output;
  MapKind kind = MapKind::kOctree;
  std::optional<double> resolution;                           ///< [m] none: derived
  double max_range = std::numeric_limits<double>::infinity(); ///< [m]
  std::optional<HeightRange> heights;                         ///< none: derived
  bool force = false;
  MemoryOption memory;
  bool quiet = false;
  std::string without_effect; ///< options without effect, in words
};

/** \return false: --help or --version was given, and the program is to end
 * \throws UsageError, boost::program_options::error the arguments break a rule */
bool
parseMapSettings(const std::vector<std::string>& arguments, MapSettings& settings);

} // namespace pcl6d::app
