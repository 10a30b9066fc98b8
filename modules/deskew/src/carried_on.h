// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace pcl6d::deskew {

/** \return the pose reached from a by s times the motion from a to b, with constant velocity in the
 * body frame \param[in] s clamped to [-1000, 1000] */
Eigen::Isometry3d
carriedOn(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double s);

} // namespace pcl6d::deskew
