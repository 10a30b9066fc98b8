// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/memory_budget.h"

#include <pcl6d/io/scan_folder.h>
#include <pcl6d/scene_interpretation/plane_finder.h>

#include <optional>
#include <string>

namespace pcl6d::app {

constexpr const char* kPlanes = "pcl_slam6d_planes"; ///< the program's name

/** \brief The command line of pcl_slam6d_planes. */
struct PlaneSettings {
  std::string input; ///< a scan, a folder of scans, or a run folder
  std::string out;
  ScanFolderOptions folder;        ///< format of a single scan, too
  std::optional<double> min_range; ///< [m] default: derived
  std::optional<double> max_range; ///< [m] default: derived
  std::optional<double> voxel;     ///< [m] of the map of a folder; default: derived
  PlaneFinderOptions step;
  std::string rules_file; ///< source of step.rules; empty: the book's rules
  bool force = false;
  MemoryOption memory;
  bool quiet = false;
  bool verbose = false;       ///< explain the labels
  std::string without_effect; ///< options without effect; else empty
};

/** \brief Fills the settings from the command line and the config file.
 * \return false after --help
 * \throws UsageError, boost::program_options::error an option is invalid */
bool
parsePlaneSettings(const std::vector<std::string>& arguments, PlaneSettings& settings);

} // namespace pcl6d::app
