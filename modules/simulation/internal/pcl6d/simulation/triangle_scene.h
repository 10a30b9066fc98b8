// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/plane.h>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A named part of a scene: the face of a wall, the top of a table. Flat for the
 * bodies of scene_builder.h. */
struct Surface {
  std::string name = "surface";
  double reflectance = 0.6; ///< share of the light sent back, in [0, 1]
  PlaneLabel label =
      PlaneLabel::kNone;    ///< kept if the orientation fits, see numberPlanes()
  std::uint32_t object = 0; ///< id of its object; 0: no object
  std::uint32_t plane = 0;  ///< id of its plane; 0: no plane
  bool is_solid = true;     ///< a viewer behind the surface is inside a body
  /** Glass: share of the rays onto its front that pass straight through, in [0, 1];
   * other rays return. From behind, inside the pane, every ray passes. A pane must
   * reach into its frame: where faces only touch, rays may slip between them. */
  double transmittance = 0;
};

/** \brief Three corners and the surface of the triangle, as indices. */
struct Triangle {
  std::array<std::uint32_t, 3> vertices = {0, 0, 0};
  std::uint32_t surface = 0;
};

/** \brief Geometry for a simulated scanner: triangles, visible from both sides.
 *
 * Adjacent triangles should share the vertices of their edge, or rays may slip between
 * them. \ingroup simulation */
struct TriangleScene {
  std::vector<Eigen::Vector3d> vertices; ///< [m]
  std::vector<Triangle> triangles;
  std::vector<Surface> surfaces;

  /** \return the index of the new surface */
  std::uint32_t
  addSurface(const Surface& surface);

  /** \brief Adds a plane convex quadrangle of four existing vertices, in order around
   * the quadrangle, as two triangles. */
  void
  addQuad(const std::array<std::uint32_t, 4>& corners, std::uint32_t surface);

  /** \return the corner of a triangle. \param[in] corner 0, 1 or 2 */
  const Eigen::Vector3d&
  corner(std::uint32_t triangle, int corner) const
  {
    return vertices[triangles[triangle].vertices[static_cast<std::size_t>(corner)]];
  }

  /** \return the unit normal of a triangle, by the right-hand rule of its corners */
  Eigen::Vector3d
  normal(std::uint32_t triangle) const;

  /** \throws BadArgument naming the first invalid vertex, triangle or surface:
   * coordinates finite, indices in range, area above zero, reflectance and
   * transmittance in [0, 1] */
  void
  validate() const;
};

} // namespace pcl6d
