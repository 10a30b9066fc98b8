// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/scan_folder.h>
#include <pcl6d/localisation/drive_localisation.h>
#include <pcl6d/localisation/segment_cut.h>
#include <pcl6d/slam6d/slam6d_options.h>

#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The command line of `pcl_slam6d_evaluate mcl`. */
struct MclSettings {
  std::string folder;
  std::string map;
  double map_scale = 1; ///< [m] per unit of a plan
  CloudSliceOptions slice;
  ScanFolderOptions scans;
  Slam6DOptions gate; ///< its range gate
  MclStart start = MclStart::kPoses;
  Eigen::Vector3d start_pose = Eigen::Vector3d::Zero(); ///< x, y [m], yaw [rad]
  bool level_by_walls = true;                           ///< else by the poses
  MclOptions mcl;
  std::string reference; ///< trajectory to compare with, or empty
  bool justify = false;
  std::string out; ///< or empty
  bool force = false;
  bool quiet = false;
  std::string without_effect; ///< warning about options without effect; may be empty
};

/** \brief Fills the settings from the command line and the config file.
 * \return false: --help was given, and the program is to end
 * \throws UsageError, boost::program_options::error an option is invalid */
bool
parseMclSettings(const std::vector<std::string>& arguments, MclSettings& settings);

} // namespace pcl6d::app
