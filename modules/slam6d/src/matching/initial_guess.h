// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/rejection.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/slam6d/slam6d_options.h>

#include <vector>

namespace pcl6d::slam6d {

/** \brief A scan with an accepted match. */
struct RegisteredScan {
  const IcpModel* points = nullptr;
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
};

/** \brief The start of ICP. */
struct StartingPose {
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  InitialGuess from = InitialGuess::kOdometry; ///< source of the pose
  Rejection rejection;                         ///< why the start is unreliable
};

/** \brief Searches for a start against the last scans with the method of the options.
 * \param[in] predicted T_world_scan by the odometry: the result for kOdometry, and for kOverlap
 * without a better start, if has_odometry
 * \param[in] placed registered scans, at least one */
StartingPose
startingPose(const Slam6DOptions& options,
             const std::vector<RegisteredScan>& placed,
             const Points& scan,
             const Eigen::Isometry3d& predicted,
             bool has_odometry);

} // namespace pcl6d::slam6d
