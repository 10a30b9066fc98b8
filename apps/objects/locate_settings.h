// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/scan_folder.h>
#include <pcl6d/object_localization/object_finder.h>

#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Settings of `locate`. */
struct LocateSettings {
  std::string input; ///< a scan, a folder of scans, or a run
  std::vector<std::string> models;
  std::string store;
  ModelFileOptions file;
  std::string out;
  ScanFolderOptions folder;
  ObjectFinderOptions finder;
  double min_range = 0;
  double max_range = 0; ///< 0: no limit
  bool fuse = true;     ///< fuse observations of several scans
  bool force = false;
  bool quiet = false;
  std::string without_effect; ///< a sentence about options without effect
};

/** \return false after --help \throws UsageError */
bool
parseLocate(const std::vector<std::string>& arguments, LocateSettings& settings);

} // namespace pcl6d::app
