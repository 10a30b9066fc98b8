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

/** \brief A part of a scene that is one thing to a person: the face of a wall, the top
 * of a table. Flat in everything that scene_builder.h makes. */
struct Surface {
  std::string name = "surface";
  double reflectance = 0.6; ///< share of the light sent back, in [0, 1]
  PlaneLabel label =
      PlaneLabel::kNone;    ///< kept where a face is fit, see numberPlanes()
  std::uint32_t object = 0; ///< id of the object that it belongs to; 0: none
  std::uint32_t plane = 0;  ///< id of its plane; 0: none
  bool is_solid = true;     ///< whoever sees it from behind is inside a body
  /** Glass: share of the rays onto its front that go through it, straight on, in [0, 1];
   * the others return from it. From behind, inside the pane, all go through. A pane has to
   * reach into what holds it: where faces just touch, rays may slip between them. */
  double transmittance = 0;
};

/** \brief Three corners and the surface that they belong to, as indices. */
struct Triangle {
  std::array<std::uint32_t, 3> vertices = {0, 0, 0};
  std::uint32_t surface = 0;
};

/** \brief What a simulated scanner looks at: triangles, seen from both sides.
 *
 * Triangles that share an edge should share its vertices, then no ray slips between
 * them. \ingroup simulation */
struct TriangleScene {
  std::vector<Eigen::Vector3d> vertices; ///< [m]
  std::vector<Triangle> triangles;
  std::vector<Surface> surfaces;

  /** \return the index of the new surface */
  std::uint32_t
  addSurface(const Surface& surface);

  /** \brief Adds a plane convex quadrangle of four existing vertices, in order around
   * it, as two triangles. */
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

  /** \throws BadArgument naming the first vertex, triangle or surface that breaks a
   * rule: coordinates finite, indices in range, area above zero, reflectance and
   * transmittance in [0, 1] */
  void
  validate() const;
};

} // namespace pcl6d
