// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/icp_basin.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/slam6d/slam6d_options.h>

#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The command line of `pcl_slam6d_evaluate icp`. */
struct IcpSettings {
  std::string scan_a; ///< the target
  std::string scan_b; ///< the source
  ScanFormat format = ScanFormat::kAuto;
  std::optional<Eigen::Isometry3d> guess; ///< T_a_b
  Slam6DOptions slam;                     ///< range gate, reduction, pair distances
  IcpMethods methods;
  IcpCombination combination = IcpCombination::kOneByOne;
  /** grid and sigma; automatic values are derived from the scans */
  IcpBasinOptions basin;
  std::optional<double> offset_xy;  ///< [m]
  std::optional<double> offset_yaw; ///< [rad]
  std::string out;                  ///< or empty
  bool force = false;
  bool quiet = false;
  std::string without_effect; ///< warning about options without effect; may be empty
};

/** \brief Fills the settings from the command line and the config file.
 * \return false: --help was given, and the program is to end
 * \throws UsageError, boost::program_options::error an option is invalid */
bool
parseIcpSettings(const std::vector<std::string>& arguments, IcpSettings& settings);

} // namespace pcl6d::app
