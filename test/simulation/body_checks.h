// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/simulation/ray_caster.h>
#include <pcl6d/simulation/triangle_scene.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace pcl6d::test {

/** \brief What a body at a place cuts of a scene: the surface that an edge of it meets above
 * its feet, or "". \param[in] foot [m] above its origin: what is lower may be in the floor */
inline std::string
cutBy(const TriangleScene& shape,
      const Eigen::Isometry3d& pose,
      const RayCaster& scene,
      double foot)
{
  for (const auto& triangle : shape.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d& a = shape.vertices[triangle.vertices[i]];
      const Eigen::Vector3d& b = shape.vertices[triangle.vertices[(i + 1) % 3]];
      if (std::min(a.z(), b.z()) < foot)
        continue;
      const Eigen::Vector3d edge = pose.linear() * (b - a);
      const auto hit = scene.cast({pose * a, edge.normalized()}, edge.norm());
      if (hit)
        return scene.scene()
            .surfaces[scene.scene().triangles[hit->triangle].surface]
            .name;
    }
  return "";
}

/** \return the distance [m] of a place to the nearest triangle of a shape */
inline double
distanceTo(const TriangleScene& shape, const Eigen::Vector3d& p)
{
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < shape.triangles.size(); ++i) {
    const Eigen::Vector3d& a = shape.corner(i, 0);
    const Eigen::Vector3d u = shape.corner(i, 1) - a;
    const Eigen::Vector3d v = shape.corner(i, 2) - a;
    Eigen::Matrix<double, 3, 2> E;
    E << u, v;
    const Eigen::Vector2d inside =
        (E.transpose() * E).inverse() * (E.transpose() * (p - a));
    if (inside.minCoeff() >= 0 && inside.sum() <= 1) {
      least = std::min(least, (p - a - E * inside).norm());
      continue;
    }
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d& from = shape.corner(i, k);
      const Eigen::Vector3d leg = shape.corner(i, (k + 1) % 3) - from;
      const double t = std::min(1.0, std::max(0.0, (p - from).dot(leg) / leg.dot(leg)));
      least = std::min(least, (p - from - t * leg).norm());
    }
  }
  return least;
}

} // namespace pcl6d::test
