// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/pose_information.h>

#include <Eigen/Geometry>

#include <optional>

/** \file
 * Covariances (x y z roll pitch yaw [m, rad]) of inverted and composed poses. */
namespace PCL6D_EXPORTS pcl6d {

/** \return the covariance of T_b_a, given that of T_a_b; nullopt if the pitch of either
 * is within 1e-3 of a right angle, where roll and yaw are not defined \ingroup
 * object_localization */
std::optional<PoseCovariance>
inverseCovariance(const PoseCovariance& covariance, const Eigen::Isometry3d& T_a_b);

/** \return the covariance of T_c_a T_a_b, given that of T_a_b and an exact T_c_a;
 * nullopt see inverseCovariance() \ingroup object_localization */
std::optional<PoseCovariance>
movedCovariance(const PoseCovariance& covariance,
                const Eigen::Isometry3d& T_c_a,
                const Eigen::Isometry3d& T_a_b);

} // namespace pcl6d
