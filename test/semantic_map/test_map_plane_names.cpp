// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/random.h>
#include <pcl6d/plane_segmentation/plane_map.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace {
/** A floor of 4 m x 4 m below the sensor and a wall behind it, 5 mm of noise. */
pcl6d::Points
corner()
{
  pcl6d::Random random(1);
  pcl6d::Points points;
  const auto noise = [&] { return static_cast<float>(0.005 * random.normal()); };
  for (int i = 0; i < 80; ++i)
    for (int k = 0; k < 80; ++k) {
      const float along = -2 + 0.05F * static_cast<float>(i);
      const float across = 0.05F * static_cast<float>(k);
      points.emplace_back(along, across - 2, -1 + noise());
      points.emplace_back(along, 2.05F + noise(), across - 0.95F);
    }
  return points;
}
} // namespace

// Two modules had a class MapPlane in one namespace: the linker kept one vector of them for
// both, and this program died.
TEST(MapPlane, OfASemanticMapAndOfAPlaneMapInOneProgram)
{
  pcl6d::SemanticMap map;
  pcl6d::PlaneMap planes;
  for (std::size_t round = 1; round <= 3; ++round) {
    for (const char* const label : {"floor", "wall", "ceiling"}) {
      pcl6d::MapPlane plane;
      plane.measured.label = label;
      plane.scans = {round};
      map.planes.push_back(plane);
    }
    const auto numbers = planes.addScan(corner(), Eigen::Isometry3d::Identity());
    EXPECT_EQ(numbers.size(), 2u);
  }
  ASSERT_EQ(map.planes.size(), 9u);
  for (std::size_t i = 0; i < map.planes.size(); ++i) {
    EXPECT_EQ(map.planes[i].scans, std::vector<std::size_t>{i / 3 + 1});
    EXPECT_FALSE(map.planes[i].refined);
  }
  EXPECT_EQ(map.planes[8].best().label, "ceiling");
  const pcl6d::MapPlanes found = planes.planes();
  EXPECT_EQ(found.place_of.size(), 6u);
  ASSERT_EQ(found.planes.size(), 2u) << "each scan continues the planes of the first";
  const Eigen::Vector3d& first = found.planes[0].plane.normal;
  const Eigen::Vector3d& second = found.planes[1].plane.normal;
  EXPECT_NEAR(std::max(std::abs(first.z()), std::abs(second.z())), 1, 1e-3);
  EXPECT_NEAR(std::max(std::abs(first.y()), std::abs(second.y())), 1, 1e-3);
  EXPECT_EQ(planes.numPoints(),
            found.planes[0].plane.inliers + found.planes[1].plane.inliers);
}
