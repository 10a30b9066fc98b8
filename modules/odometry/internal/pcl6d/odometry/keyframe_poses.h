// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Selects keyframes among sweeps of known poses: the first sweep, each sweep farther
 * than a distance from the keyframe before or turned by more than an angle against it, and
 * the last sweep.
 * \param[in] poses T_world_sweep in order, at least one
 * \param[in] way [m] > 0 \param[in] turn [rad] > 0
 * \return indices of the keyframes, increasing
 * \throws BadArgument no pose, or way or turn out of range
 * \note Source: T. Shan et al., "LIO-SAM: tightly-coupled lidar inertial odometry via smoothing and
 * mapping", IROS 2020, section III.D. \ingroup odometry */
std::vector<std::size_t>
keyframesAlong(const std::vector<Eigen::Isometry3d>& poses, double way, double turn);

/** \brief Corrects the poses of all sweeps by the corrected poses of the keyframes.
 *
 * A keyframe gets its corrected pose. A sweep between two keyframes keeps its tracked motion
 * relative to each keyframe, which gives two poses; its pose is interpolated between both by the
 * number of sweeps to either keyframe: linearly in position, by slerp in rotation (book A.1).
 * Sweeps before the first and behind the last keyframe keep their motion relative to this keyframe.
 * \param[in] tracked T_world_sweep of all sweeps in order
 * \param[in] keyframes indices of the keyframes, increasing, at least one
 * \param[in] corrected T_world_sweep of the keyframes, in a world of their own
 * \return T_world_sweep of all sweeps in the world of the corrected poses
 * \throws BadArgument keyframes are missing, not increasing or beyond the end, or their number
 * differs from the corrected poses \ingroup odometry */
std::vector<Eigen::Isometry3d>
posesByKeyframes(const std::vector<Eigen::Isometry3d>& tracked,
                 const std::vector<std::size_t>& keyframes,
                 const std::vector<Eigen::Isometry3d>& corrected);

} // namespace pcl6d
