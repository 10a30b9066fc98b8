// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/io/scan_folder.h>

#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The command line of `pcl_slam6d_evaluate verify`. */
struct VerifySettings {
  std::vector<std::string> inputs; ///< a folder, or two scans
  std::string poses; ///< file of poses in place of the folder's; may be empty
  std::string pose;  ///< of a pair: numbers or a file; or empty
  ScanFolderOptions scans;
  ScanParameterOptions parameters;
  std::size_t rows = 10;
  unsigned int num_threads = 0;
  std::string out; ///< or empty
  bool force = false;
  bool quiet = false;
  std::string without_effect; ///< warning about options without effect; may be empty

  bool
  isPair() const
  {
    return inputs.size() == 2;
  }
};

/** \brief Fills the settings from the command line and the config file.
 * \return false: --help was given, and the program is to end
 * \throws UsageError, boost::program_options::error an option is invalid */
bool
parseVerifySettings(const std::vector<std::string>& arguments,
                    VerifySettings& settings);

} // namespace pcl6d::app
