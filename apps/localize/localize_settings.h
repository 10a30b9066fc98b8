// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/io/scan_folder.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pcl6d::app {

constexpr const char* kLocalize = "pcl_slam6d_localize"; ///< the program's name

/** \brief The command line of pcl_slam6d_localize. */
struct LocalizeSettings {
  std::string run;                           ///< folder of the finished map
  std::vector<std::filesystem::path> inputs; ///< folder or files of further scans
  std::string out;
  ScanFolderOptions folder;
  ScanParameterOptions parameters;
  unsigned int num_threads = 0; ///< 0: one per core; never changes the result
  bool force = false;
  bool quiet = false;
};

/** \brief Fills the settings. \return false if the program should end (--help)
 * \throws UsageError, boost::program_options::error an option is invalid */
bool
parseLocalizeSettings(const std::vector<std::string>& arguments,
                      LocalizeSettings& settings);

} // namespace pcl6d::app
