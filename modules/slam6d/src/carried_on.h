// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace pcl6d::slam6d {

/** \return where a motion from a to b leads when it goes on for s times its length, as seen
 * from the body \param[in] s beyond 1000 it ends there */
Eigen::Isometry3d
carriedOn(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double s);

} // namespace pcl6d::slam6d
