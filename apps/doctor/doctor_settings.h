// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/scan_reader.h>

#include <Eigen/Core>

#include <optional>
#include <string>

namespace pcl6d::app {

constexpr const char* kDoctor = "pcl_slam6d_doctor"; ///< the program's name

/** \brief The command line of pcl_slam6d_doctor. */
struct DoctorSettings {
  std::string source, target; ///< files
  std::string guess;          ///< T_target_source: numbers or a file; or empty
  std::string indices;        ///< file of point numbers of the source; or empty
  ScanFormat format = ScanFormat::kAuto;
  std::optional<Eigen::Vector3d> source_origin; ///< [m] position of the scanner
  std::optional<Eigen::Vector3d> target_origin;
  std::optional<double> max_distance; ///< [m] none: derived
  double time_limit = 30;             ///< [s] of each run
  std::string html;                   ///< or empty
  std::string json;                   ///< or empty
  bool quiet = false;
};

/** \brief Fills the settings from the command line and the config file.
 * \return false: --help was given, and the program is to end
 * \throws UsageError, boost::program_options::error an option is invalid */
bool
parseDoctorSettings(const std::vector<std::string>& arguments,
                    DoctorSettings& settings);

} // namespace pcl6d::app
