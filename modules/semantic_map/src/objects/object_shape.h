// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scene_interpretation/scene_plane.h>
#include <pcl6d/semantic_map/semantic_map.h>

/** \file Boxes of objects in an upright frame. Internal to the module semantic_map. */
namespace pcl6d::semantic_map {

/** \brief The box of an object, seen from above and from the side. */
struct ObjectShape {
  ScenePlane footprint; ///< hull of the box in plan, at height 0
  ScenePlane foot;      ///< one corner: the middle of the box, at its lowest height
  double bottom = 0;    ///< [m]
  double top = 0;       ///< [m]
};

/** \return the rotation that turns up to the z axis */
Eigen::Matrix3d
levelling(const Eigen::Vector3d& up);

ObjectShape
shapeOf(const ObjectPose& object, const Eigen::Matrix3d& R_level_map);

/** \return the plane with its corners at height 0 */
ScenePlane
flattened(ScenePlane plane);

/** \return whether a point [m] lies in the box of an object, grown by margin */
bool
isInBox(const ObjectPose& object, const Eigen::Vector3d& point, double margin);

} // namespace pcl6d::semantic_map
