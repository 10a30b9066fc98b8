// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/pair_sums.h>
#include <pcl6d/registration/plane_sums.h>

#include <optional>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Covariance of a pose (x, y, z, roll, pitch, yaw) [m, rad].  */
using PoseCovariance = Eigen::Matrix<double, 6, 6>;
/** \brief Inverse of PoseCovariance [1/m, 1/rad]; zero along motions that are not fixed. */
using PoseInformation = Eigen::Matrix<double, 6, 6>;

/** \brief Information of matched pairs about a pose (book 4.1.3, 5.2): H^T (sum M^T M) H / s^2,
 * turned from the twist into position and Euler angles.
 *
 * The pairs are assumed independent, which closest points are not: the result is a relative weight,
 * too optimistic for an absolute accuracy. \param[in] sums pairs at the pose, both sides in the
 * frame of the target (world) \param[in] T_world_scan the pose
 * \return empty for fewer than 3 pairs, for pairs without error (s = 0), or within 1e-3 of a pitch
 * of a right angle, where roll and yaw are not defined
 * \note Source: P. Lu, E. Milios 1997 in six dimensions; s^2 by 3 N - 6. */
std::optional<PoseInformation>
poseInformation(const PairSums& sums, const Eigen::Isometry3d& T_world_scan);

/** \brief poseInformation() of pairs with normals; s^2 by N - 6. */
std::optional<PoseInformation>
poseInformation(const PlaneSums& sums, const Eigen::Isometry3d& T_world_scan);

/** \brief The inverse of poseInformation(), s^2 (M^T M)^-1 in position and Euler angles.
 * \return empty, too, when the pairs do not fix the pose (on one line; a single plane) */
std::optional<PoseCovariance>
poseCovariance(const PairSums& sums, const Eigen::Isometry3d& T_world_scan);

std::optional<PoseCovariance>
poseCovariance(const PlaneSums& sums, const Eigen::Isometry3d& T_world_scan);

} // namespace pcl6d
