// SPDX-License-Identifier: BSD-3-Clause
#include "objects/object_shape.h"

#include <pcl6d/common/rotation.h>

namespace pcl6d::semantic_map {

Eigen::Matrix3d
levelling(const Eigen::Vector3d& up)
{
  return shortestRotation(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

ObjectShape
shapeOf(const ObjectPose& object, const Eigen::Matrix3d& R_level_map)
{
  ObjectShape shape;
  Eigen::AlignedBox3d bounds;
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner =
        R_level_map *
        (object.T_world_object *
         object.box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
    bounds.extend(corner);
    corners.emplace_back(corner.x(), corner.y(), 0);
  }
  shape.bottom = bounds.min().z();
  shape.top = bounds.max().z();
  shape.footprint.corners = convexHull(corners, Eigen::Vector3d::UnitZ());
  if (shape.footprint.corners.empty()) // a box of no size
    shape.footprint.corners.push_back(corners.front());
  const Eigen::Vector3d middle =
      R_level_map * (object.T_world_object * object.box.center());
  shape.footprint.centre = {middle.x(), middle.y(), 0};
  shape.foot.centre = {middle.x(), middle.y(), shape.bottom};
  shape.foot.corners = {shape.foot.centre};
  return shape;
}

ScenePlane
flattened(ScenePlane plane)
{
  for (auto& corner : plane.corners)
    corner.z() = 0;
  plane.normal = Eigen::Vector3d::UnitZ();
  return plane;
}

bool
isInBox(const ObjectPose& object, const Eigen::Vector3d& point, double margin)
{
  const Eigen::Vector3d local = object.T_world_object.inverse() * point;
  return ((local - object.box.min()).array() >= -margin).all() &&
         ((local - object.box.max()).array() <= margin).all();
}

} // namespace pcl6d::semantic_map
