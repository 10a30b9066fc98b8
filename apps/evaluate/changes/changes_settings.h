// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/filters/scan_parameters.h>

#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The command line of `pcl_slam6d_evaluate changes`. */
struct ChangesSettings {
  std::string run_a, run_b;
  bool given = false; ///< both runs share a world: their poses are used unchanged
  ScanParameterOptions parameters;
  double min_confidence = 0.99;
  double least_size = 3; ///< voxels
  std::size_t rows = 20;
  unsigned int num_threads = 0;
  std::string json; ///< or empty
  std::string out;  ///< or empty
  bool force = false;
  bool quiet = false;
  std::string without_effect; ///< warning about options without effect; may be empty
};

/** \brief Fills the settings from the command line and the config file.
 * \return false: --help was given, and the program is to end
 * \throws UsageError, boost::program_options::error an option is invalid */
bool
parseChangesSettings(const std::vector<std::string>& arguments,
                     ChangesSettings& settings);

} // namespace pcl6d::app
