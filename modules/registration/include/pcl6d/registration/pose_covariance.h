// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/pair_sums.h>

#include <optional>

namespace pcl6d {

/** \brief Covariance of a pose (x, y, z, roll, pitch, yaw) [m, rad].  */
using PoseCovariance = Eigen::Matrix<double, 6, 6>;

/** \brief How precisely matched pairs fix a pose (book 4.1.3, 5.2): s^2 (M^T M)^-1,
 * turned from the twist into position and Euler angles.
 *
 * The pairs count as independent, which closest points are not: the result is a
 * relative weight and optimistic as an absolute accuracy. \param[in] sums pairs at the
 * pose, both sides in the frame of the target (world) \param[in] T_world_scan the pose
 * \return nothing when the pairs do not fix the pose (fewer than 3, on one line) or the
 * pitch is within 1e-3 of a right angle, where roll and yaw are not defined
 * \note Source: P. Lu, E. Milios 1997 in six dimensions; divisor 3 N - 6. */
std::optional<PoseCovariance>
poseCovariance(const PairSums& sums, const Eigen::Isometry3d& T_world_scan);

} // namespace pcl6d
