// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A half line. \ingroup scanner */
struct Ray {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();     ///< [m]
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX(); ///< unit length
};

} // namespace pcl6d
