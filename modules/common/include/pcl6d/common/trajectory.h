// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The poses of a run in order, with time stamps if available.
 * \ingroup common */
struct Trajectory {
  std::vector<Eigen::Isometry3d> poses; ///< T_world_scan [m]
  std::vector<double> stamps;           ///< [s], one per pose, or empty
};

} // namespace pcl6d
