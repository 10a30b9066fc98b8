// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/triangle_scene.h>

/** \file
 * Solid bodies for simulated scenes. Each body has thickness, so that none can be seen
 * from behind through a crack; bodies may touch or overlap. Every flat face becomes a
 * surface of its own. Lengths in metres, z up. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief A cuboid that stands upright. */
struct Box {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d size = Eigen::Vector3d::Ones(); ///< along its own axes, each > 0
  double yaw = 0; ///< [rad] turn of the axes about the vertical
};

void
addBox(TriangleScene& scene, const Box& box, const Surface& material);

/** \brief A cuboid along the axes between two opposite corners, low < high. */
void
addBox(TriangleScene& scene,
       const Eigen::Vector3d& low,
       const Eigen::Vector3d& high,
       const Surface& material);

/** \brief A hole in a wall: a door, window or niche. */
struct Opening {
  double begin = 0; ///< [m] from the start of the wall
  double end = 1;   ///< [m] > begin
  double low = 0;   ///< [m] height of the sill, in the scene
  double high = 2;  ///< [m] height of the lintel, > low
};

/** \brief An upright straight wall. */
struct Wall {
  Eigen::Vector2d from = Eigen::Vector2d::Zero(); ///< centre line, in the x-y plane
  Eigen::Vector2d to = Eigen::Vector2d::UnitX();
  double thickness = 0.2;
  double bottom = 0; ///< height of its foot
  double top = 2.5;
  std::vector<Opening> openings; ///< in order along the wall, without overlap
};

/** \brief Adds a wall as one body per piece between openings; the pieces share the
 * surfaces of the wall's two faces. \throws BadArgument an opening lies outside the
 * wall or begins before the previous opening ends */
void
addWall(TriangleScene& scene, const Wall& wall, const Surface& material);

/** \brief A wedge whose upper face rises or falls evenly along its centre line. */
struct Ramp {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::UnitX();
  double width = 1;
  double bottom = -0.2;   ///< height of its flat lower face
  double from_height = 0; ///< height of the upper face at the start, > bottom
  double to_height = 0.5; ///< height at the end, > bottom
};

void
addRamp(TriangleScene& scene, const Ramp& ramp, const Surface& material);

} // namespace pcl6d
