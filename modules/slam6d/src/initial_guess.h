// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/icp_model.h>
#include <pcl6d/slam6d/slam6d_options.h>

#include <string>
#include <vector>

namespace pcl6d::slam6d {

/** \brief A scan whose match is believed. */
struct BelievedScan {
  const IcpModel* points = nullptr;
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
};

/** \brief Where ICP starts. */
struct StartingPose {
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  InitialGuess from = InitialGuess::kOdometry; ///< what it comes from
  std::string doubt; ///< why there is none to be believed; else empty
};

/** \brief Looks for a start as the options say, against one of the last scans.
 * \param[in] predicted T_world_scan by the odometry: the answer for kOdometry, and for
 * kOverlap where no better one is found, if has_odometry
 * \param[in] placed at least one */
StartingPose
startingPose(const Slam6DOptions& options,
             const std::vector<BelievedScan>& placed,
             const Points& scan,
             const Eigen::Isometry3d& predicted,
             bool has_odometry);

} // namespace pcl6d::slam6d
