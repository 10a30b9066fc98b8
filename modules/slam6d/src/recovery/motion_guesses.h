// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <vector>

/** \file Candidate poses of a lost scan, from the odometry and from the motion before it was lost. */
namespace pcl6d::slam6d {

/** Motion since the last registered scan. */
struct MotionSinceLast {
  std::size_t last = 0;  ///< last registered scan
  std::size_t steps = 0; ///< since last
  Eigen::Isometry3d T_world_last = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d odometry = Eigen::Isometry3d::Identity(); ///< predicted, since last
  /** previous motion repeated; the odometry if unknown */
  Eigen::Isometry3d carried = Eigen::Isometry3d::Identity();
  double deviation = 0; ///< [m] of the odometry over all steps
};

/** \return a motion repeated: motion^count */
PCL6D_EXPORTS Eigen::Isometry3d // exported for its test
repeated(const Eigen::Isometry3d& motion, std::size_t count);

/** \return [m] rms correction of the latest scans before an index that were registered from
 * odometry; at least `least` */
double
deviationOfStep(const std::vector<ScanResult>& scans, std::size_t before, double least);

/** \param[in] voxel [m] least deviation of the odometry in a step
 * \return the motion from the last registered scan to this scan; none if no scan before is
 * registered */
std::optional<MotionSinceLast>
motionSinceLast(std::size_t scan, const std::vector<ScanResult>& scans, double voxel);

/** \return T_world_scan by odometry, by the motion before, by mixtures of both, and the pose of the
 * last registered scan */
std::vector<Eigen::Isometry3d>
posesByMotion(const MotionSinceLast& way);

/** \return poses around a pose: turned about the vertical, and shifted to four sides
 * \param[in] up in the frame of the pose \param[in] by [m] */
std::vector<Eigen::Isometry3d>
posesAround(const Eigen::Isometry3d& about, const Eigen::Vector3d& up, double by);

} // namespace pcl6d::slam6d
