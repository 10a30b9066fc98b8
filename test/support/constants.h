// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <cmath>

namespace pcl6d::test {

constexpr double kDegree = M_PI / 180; ///< [rad]

inline const Eigen::Vector3d kX = Eigen::Vector3d::UnitX();
inline const Eigen::Vector3d kY = Eigen::Vector3d::UnitY();
inline const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();
inline const Eigen::Isometry3d kIdentity = Eigen::Isometry3d::Identity();

} // namespace pcl6d::test
