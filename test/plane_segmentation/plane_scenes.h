// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/random.h>

#include <cstddef>

namespace pcl6d::test {

/** \brief Appends points of a rectangle, evenly by chance.
 * \param[in] corner, a, b [m] one corner and the sides from there
 * \param[in] noise [m] along the normal, evenly in [-noise, noise] */
inline void
addRectangle(Points& points,
             const Eigen::Vector3d& corner,
             const Eigen::Vector3d& a,
             const Eigen::Vector3d& b,
             std::size_t count,
             double noise,
             Random& random)
{
  const Eigen::Vector3d normal = a.cross(b).normalized();
  for (std::size_t i = 0; i < count; ++i) {
    const double s = random.uniform(), t = random.uniform();
    const double height = noise * random.uniform(-1, 1);
    points.push_back((corner + s * a + t * b + height * normal).cast<float>());
  }
}

/** \brief The faces of a cube about the origin, one after the other: -x, +x, -y, +y, -z,
 * +z. \param[in] edge [m] \param[in] count of points of a face */
inline Points
noisyCube(double edge, std::size_t count, double noise, std::uint64_t seed)
{
  Points points;
  Random random(seed);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-0.5, 0.5}) {
      Eigen::Vector3d corner = Eigen::Vector3d::Constant(-edge / 2);
      corner[axis] = side * edge;
      const Eigen::Vector3d a = edge * Eigen::Vector3d::Unit((axis + 1) % 3);
      const Eigen::Vector3d b = edge * Eigen::Vector3d::Unit((axis + 2) % 3);
      addRectangle(points, corner, a, b, count, noise, random);
    }
  return points;
}

/** \brief Points of a sphere about the origin, evenly by chance. */
inline Points
sphere(double radius, std::size_t count, std::uint64_t seed)
{
  Points points;
  Random random(seed);
  while (points.size() < count) {
    const Eigen::Vector3d p(random.normal(), random.normal(), random.normal());
    points.push_back((radius * p.normalized()).cast<float>());
  }
  return points;
}

} // namespace pcl6d::test
