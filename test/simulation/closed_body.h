// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/simulation/triangle_scene.h>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

namespace pcl6d::test {

/** \return the volume inside surfaces whose normals point outwards (divergence
 * theorem) */
inline double
volume(const TriangleScene& scene)
{
  double sum = 0;
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i)
    sum += scene.corner(i, 0).dot(scene.corner(i, 1).cross(scene.corner(i, 2))) / 6;
  return sum;
}

/** In a closed surface each edge is used as often one way as the other. */
inline void
expectClosed(const TriangleScene& scene)
{
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const auto& triangle : scene.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const auto a = triangle.vertices[i];
      const auto b = triangle.vertices[(i + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  for (const auto& [edge, count] : balance)
    EXPECT_EQ(count, 0) << "edge " << edge.first << " - " << edge.second;
}

} // namespace pcl6d::test
