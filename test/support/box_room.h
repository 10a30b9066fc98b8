// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/plane.h>
#include <pcl6d/common/random.h>
#include <pcl6d/plane_segmentation/plane_segment.h>

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace pcl6d::test {

/** \brief A rectangle with its true label, and the side from which it was seen. */
struct TruePlane {
  Plane plane;
  Eigen::Vector3d seen_from = Eigen::Vector3d::UnitZ();
};

/** \return the rectangle about a centre, spanned by two half sides [m]; seen from the
 * side of their cross product */
inline TruePlane
rectangle(const std::string& label,
          const Eigen::Vector3d& centre,
          const Eigen::Vector3d& u,
          const Eigen::Vector3d& v)
{
  TruePlane result;
  result.seen_from = u.cross(v).normalized();
  Plane& plane = result.plane;
  plane.label = label;
  plane.normal = result.seen_from;
  plane.offset = plane.normal.dot(centre);
  plane.area = 4 * u.cross(v).norm();
  plane.hull = {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
  orientPlane(plane);
  return result;
}

/** \brief A furnished room: floor and ceiling, four walls, a closed door in the wall at
 * low y, a table and a cabinet. */
struct BoxRoom {
  double length = 5;       ///< [m] along x
  double width = 4;        ///< [m] along y
  double height = 2.6;     ///< [m]
  double base = 0;         ///< [m] height of the floor
  double door_place = 0.5; ///< share of the length

  std::vector<TruePlane>
  planes() const
  {
    using Vector = Eigen::Vector3d;
    const double l = length / 2, w = width / 2, h = height / 2, z = base + h;
    const Vector x = Vector::UnitX(), y = Vector::UnitY(), up = Vector::UnitZ();
    const double door_x = (door_place - 0.5) * (length - 1.2);
    return {rectangle("floor", {0, 0, base}, l * x, w * y),
            rectangle("ceiling", {0, 0, base + height}, w * y, l * x),
            rectangle("wall", {-l, 0, z}, w * y, h * up),
            rectangle("wall", {l, 0, z}, h * up, w * y),
            rectangle("wall", {0, -w, z}, h * up, l * x),
            rectangle("wall", {0, w, z}, l * x, h * up),
            rectangle("door", {door_x, -w - 0.04, base + 1.02}, 1.02 * up, 0.46 * x),
            rectangle("none", {0, 0.3 * width, base + 0.74}, 1.0 * x, 0.45 * y),
            rectangle("none", {l - 0.5, 0, base + 0.6}, 0.6 * up, 0.5 * y)};
  }
};

inline std::vector<Plane>
planesOf(const std::vector<TruePlane>& truth)
{
  std::vector<Plane> planes;
  for (const auto& t : truth)
    planes.push_back(t.plane);
  return planes;
}

inline std::vector<Eigen::Vector3d>
sidesOf(const std::vector<TruePlane>& truth)
{
  std::vector<Eigen::Vector3d> sides;
  for (const auto& t : truth)
    sides.push_back(t.seen_from);
  return sides;
}

inline std::vector<std::string>
labelsOf(const std::vector<TruePlane>& truth)
{
  std::vector<std::string> labels;
  for (const auto& t : truth)
    labels.push_back(t.plane.label);
  return labels;
}

/** \return the planes turned by R */
inline std::vector<TruePlane>
turned(std::vector<TruePlane> truth, const Eigen::Matrix3d& R)
{
  for (auto& t : truth) {
    t.plane.normal = R * t.plane.normal;
    t.seen_from = R * t.seen_from;
    for (auto& corner : t.plane.hull)
      corner = R * corner;
    orientPlane(t.plane);
  }
  return truth;
}

} // namespace pcl6d::test
