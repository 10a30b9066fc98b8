// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/triangle_mesh.h>
#include <pcl6d/simulation/triangle_scene.h>

#include <Eigen/Geometry>

/** \file
 * Bodies for simulated scenes: round bodies, stairs, meshes and whole models. Flat
 * bodies: scene_builder.h. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief A body of revolution about an upright axis: a cylinder, a cone, the crown of
 * a tree. */
struct Revolved {
  Eigen::Vector3d foot = Eigen::Vector3d::Zero(); ///< where its axis starts
  /** (radius, height above the foot) [m] from bottom to top, at least 2; radius > 0,
   * heights increasing. Both ends get a flat lid. */
  std::vector<Eigen::Vector2d> profile = {{0.5, 0}, {0.5, 1}};
  int segments = 24; ///< corners around the axis, on the circle; >= 3
};

/** \brief Adds a body of revolution with three surfaces: its shell, its lower and its
 * upper lid.
 * \throws BadArgument a field is invalid */
void
addRevolved(TriangleScene& scene, const Revolved& body, const Surface& material);

/** \brief Upright cylinder. \param[in] foot [m] middle of its lower lid */
void
addCylinder(TriangleScene& scene,
            const Eigen::Vector3d& foot,
            double radius,
            double height,
            const Surface& material);

/** \brief A straight flight of stairs, each step solid down to the bottom. */
struct Stairs {
  Eigen::Vector2d from = Eigen::Vector2d::Zero(); ///< start of the centre line
  Eigen::Vector2d to = Eigen::Vector2d::UnitX();
  double width = 1;
  double bottom = -0.2;   ///< [m] height of its flat lower face
  double from_height = 0; ///< [m] of the floor in front of the first step; > bottom
  double to_height = 1;   ///< [m] of the last tread; > from_height
  int steps = 6;          ///< >= 1
};

/** \throws BadArgument a field is invalid */
void
addStairs(TriangleScene& scene, const Stairs& stairs, const Surface& material);

/** \brief Adds a mesh as one surface. \param[in] material is_solid only for a closed
 * mesh, with triangles counter-clockwise seen from outside */
void
addMesh(TriangleScene& scene,
        const TriangleMesh& mesh,
        const Eigen::Isometry3d& T_scene_mesh,
        const Surface& material);

/** \brief Adds a whole model with its surfaces.
 * \param[in] object id for its surfaces; 0 keeps their ids */
void
addModel(TriangleScene& scene,
         const TriangleScene& model,
         const Eigen::Isometry3d& T_scene_model,
         std::uint32_t object = 0);

} // namespace pcl6d
