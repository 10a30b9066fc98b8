// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/poses.h"

#include <pcl6d/search/neighbour.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl6d::test {

/** The oracle: all finite points nearer than the limit, sorted by distance, then index.
 */
inline std::vector<Neighbour>
allWithin(const Points& points, const Eigen::Vector3f& q, float limit_sq)
{
  std::vector<Neighbour> found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3f d = q - points[i];
    const float sq = d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
    if (sq < limit_sq)
      found.push_back({static_cast<int>(i), sq});
  }
  std::sort(found.begin(), found.end(), [](const Neighbour& a, const Neighbour& b) {
    return std::pair(a.distance_sq, a.index) < std::pair(b.distance_sq, b.index);
  });
  return found;
}

template <typename Vector>
Vector
firstOf(Vector found, std::size_t count)
{
  found.resize(std::min(found.size(), count));
  return found;
}

inline void
expectEqual(const std::vector<Neighbour>& found, const std::vector<Neighbour>& expected)
{
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].index, expected[i].index) << "neighbour " << i;
    ASSERT_EQ(found[i].distance_sq, expected[i].distance_sq) << "neighbour " << i;
  }
}

/** Points on an integer grid, each several times: as many ties as there can be. */
inline Points
gridWithDuplicates(Random& random, std::size_t count)
{
  Points points(count);
  for (auto& p : points)
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = std::floor(static_cast<float>(random.uniform(0, 5)));
  return points;
}

} // namespace pcl6d::test
