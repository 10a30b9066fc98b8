// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

/** \file Polygons in the plane and on planes in space: orientation, area, containment, distance,
 * convex hull, triangulation. A polygon is the ordered list of its corners [m]; the last corner
 * joins the first. \ingroup common */
namespace PCL6D_EXPORTS pcl6d {

struct Plane;

/** \return the area of the parallelogram of two vectors; positive if b is left of a */
inline double
cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

/** \return twice the area of a triangle; positive if the way a, b, c turns left */
inline double
leftTurn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  return cross(b - a, c - a);
}

/** \return the area inside: positive if counter-clockwise */
double
signedArea(const std::vector<Eigen::Vector2d>& ring);

/** \return whether a ray from p crosses the ring an odd number of times */
bool
isInside(const std::vector<Eigen::Vector2d>& ring, const Eigen::Vector2d& p);

/** \brief Containment in several rings together, for example islands and the lakes inside. */
bool
isInside(const std::vector<std::vector<Eigen::Vector2d>>& rings,
         const Eigen::Vector2d& p);

/** \return whether a point, projected along the normal, lies in a convex polygon grown by margin
 * [m] */
bool
isInside(const std::vector<Eigen::Vector3d>& polygon,
         const Eigen::Vector3d& normal,
         const Eigen::Vector3d& point,
         double margin);

/** \return the extent of points along a unit vector [m] */
double
extentAlong(const std::vector<Eigen::Vector3d>& corners,
            const Eigen::Vector3d& direction);

/** \return the centroid of a convex polygon; the mean of the corners if the area is zero */
Eigen::Vector3d
centreOfArea(const std::vector<Eigen::Vector3d>& corners);

/** \return whether a line parallel or perpendicular to an edge of a, in plan, separates the
 * convex polygons by more than margin [m] (separating axes) */
bool
apartAcrossEdgesOf(const std::vector<Eigen::Vector3d>& a,
                   const std::vector<Eigen::Vector3d>& b,
                   double margin);

/** \return the smallest distance [m] between the edges of two convex polygons, or from
 * an edge of b to the inside of a. \param[in] normal of a */
double
hullToHull(const std::vector<Eigen::Vector3d>& a,
           const Eigen::Vector3d& normal,
           const std::vector<Eigen::Vector3d>& b);

/** \return the convex hull of points on a plane, counter-clockwise seen against the normal;
 * corners on an edge are left out
 * \param[in] normal unit normal of the plane
 * \note Source: A. M. Andrew, "Another efficient algorithm for convex hulls in two
 * dimensions", Information Processing Letters 9(5), 1979. */
std::vector<Eigen::Vector3d>
convexHull(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& normal);

/** \brief Triangulates a flat polygon with holes by ear clipping.
 *
 * Rings are lists of corners on a plane: outer rings counter-clockwise seen against the normal,
 * each followed by its holes, clockwise. Rings of fewer than 3 corners, and holes without an
 * outer ring, are left out. Triangles may overlap if rings cross; the number of triangles
 * always equals that of a proper polygon. O(n^2) for n corners in general.
 * \return counter-clockwise triangles; indices count the corners of all rings in order
 * \note Source: G. H. Meisters, "Polygons have ears", American Mathematical Monthly 82(6),
 * 1975; a cut to a visible corner joins each hole to the outer ring. */
std::vector<std::array<std::uint32_t, 3>>
triangulate(const std::vector<std::vector<Eigen::Vector3d>>& rings,
            const Eigen::Vector3d& normal);

/** \brief The space over and under the convex hull of a plane, without end. */
class HullPrism {
public:
  /** \param[in] plane without corners the prism is all of space */
  explicit HullPrism(const Plane& plane);

  /** \return whether a point is in the prism grown by a margin [m] */
  bool
  covers(const Eigen::Vector3d& point, double margin = 0) const
  {
    const Eigen::Vector4d place = point.homogeneous();
    return std::all_of(sides_.begin(), sides_.end(), [&](const Eigen::Vector4d& side) {
      return side.dot(place) <= margin;
    });
  }

private:
  std::vector<Eigen::Vector4d> sides_; // unit normal outwards n and -d, outside n.p > d
};

} // namespace pcl6d
