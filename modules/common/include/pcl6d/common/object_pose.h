// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief An object of a known class with pose and box (book 7.2). \ingroup common */
struct ObjectPose {
  std::string object_class; ///< "chair"
  Eigen::Isometry3d T_world_object = Eigen::Isometry3d::Identity();
  Eigen::AlignedBox3d box{Eigen::Vector3d::Zero(),
                          Eigen::Vector3d::Zero()}; ///< [m] in the object's frame
  bool moves = false;                               ///< the pose is that of the start
  std::size_t points = 0;                           ///< points on the object
};

} // namespace pcl6d
