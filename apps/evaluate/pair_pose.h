// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/scan_reader.h>

#include <Eigen/Geometry>

#include <string>

namespace pcl6d::app {

/** \brief The pose of a scan B seen from a scan A. */
struct PairPose {
  Eigen::Isometry3d T_a_b = Eigen::Isometry3d::Identity();
  std::string source; ///< for people
  bool found = true;  ///< false: the identity, for want of a pose
};

/** \brief Six numbers, x y z [m] roll pitch yaw [deg]. \param[in] option name of the
 * option
 * \throws UsageError not six numbers */
Eigen::Isometry3d
poseFromText(const std::string& option, const std::string& text);

/** \brief The numbers of a file: 6 as poseFromText(), 12 or 16 of a matrix, row by row.
 * \throws IoFailed unreadable, another count of numbers, or no rigid motion */
Eigen::Isometry3d
poseFromFile(const std::string& file);

/** \brief The pose from the initial poses in the folders of the scans, for the points
 * as stored in the files.
 * \param[in] option recommended in messages
 * \throws IoFailed as ScanFolder, or the two scans have poses of different kinds */
PairPose
poseOfPair(const std::string& scan_a,
           const std::string& scan_b,
           ScanFormat format,
           const std::string& option);

} // namespace pcl6d::app
