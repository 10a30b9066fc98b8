// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/pose_information.h>

#include <Eigen/Geometry>

#include <optional>

/** \file
 * Covariances (x y z roll pitch yaw [m, rad]) of poses that are made of others. */
namespace PCL6D_EXPORTS pcl6d {

/** \return that of T_b_a from that of T_a_b; none within 1e-3 of a pitch of a right angle
 * of either, where roll and yaw are not defined \ingroup object_localization */
std::optional<PoseCovariance>
inverseCovariance(const PoseCovariance& covariance, const Eigen::Isometry3d& T_a_b);

/** \return that of T_c_a T_a_b from that of T_a_b, T_c_a being exact; none as
 * inverseCovariance() \ingroup object_localization */
std::optional<PoseCovariance>
movedCovariance(const PoseCovariance& covariance,
                const Eigen::Isometry3d& T_c_a,
                const Eigen::Isometry3d& T_a_b);

} // namespace pcl6d
