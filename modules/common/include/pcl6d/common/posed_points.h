// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <Eigen/Geometry>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Points with the pose of their frame. \ingroup common */
struct PosedPoints {
  Points points;                                          ///< [m] in their own frame
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity(); ///< of their frame
};

} // namespace pcl6d
