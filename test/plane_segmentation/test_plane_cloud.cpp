// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

TEST(PlaneCloud, LeavesOutWhatIsNotFiniteAndKnowsThePlaceOfTheRest)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  pcl6d::Points points{{nan, 0, 0}};
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 10; ++y)
      points.emplace_back(0.1f * x, 0.1f * y, 2.f);
  const pcl6d::PlaneCloud cloud(points);
  ASSERT_EQ(cloud.points().size(), 100u);
  EXPECT_EQ(cloud.places().front(), 1u);
  EXPECT_EQ(cloud.places().back(), 100u);
  ASSERT_EQ(cloud.normals().size(), 100u);
  EXPECT_NEAR(cloud.normals()[42].z(), -1.f, 1e-6); // towards the scanner
}

namespace {
/** What a camera at the origin that looks along x sees of a corner of a room: floor at
 * z = -1, walls at y = 2 and x = 4; every 50th ray returns nothing. */
pcl6d::Points
cornerSeenByCamera(std::size_t width, std::size_t height)
{
  pcl6d::Points points;
  for (std::size_t row = 0; row < height; ++row)
    for (std::size_t column = 0; column < width; ++column) {
      const double y =
          0.9 - 1.4 * static_cast<double>(column) / static_cast<double>(width);
      const double z =
          0.3 - 1.0 * static_cast<double>(row) / static_cast<double>(height);
      double range = 4;
      if (y > 0)
        range = std::min(range, 2 / y);
      if (z < 0)
        range = std::min(range, -1 / z);
      const bool lost = (row * width + column) % 50 == 0;
      const double x = lost ? std::numeric_limits<double>::quiet_NaN() : range;
      points.push_back(Eigen::Vector3d(x, x * y, x * z).cast<float>());
    }
  return points;
}
} // namespace

TEST(PlaneCloud, FindsTheSamePlanesByTheGridAsByTheTree)
{
  const pcl6d::Points points = cornerSeenByCamera(160, 120);
  pcl6d::PlaneCloudOptions options;
  const auto by_tree = segmentPlanes(pcl6d::PlaneCloud(points, options));
  options.width = 160;
  const pcl6d::PlaneCloud organized(points, options);
  const auto by_grid = segmentPlanes(organized);
  ASSERT_EQ(by_tree.planes.size(), 3u);
  ASSERT_EQ(by_grid.planes.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& a = by_tree.planes[i].plane;
    const auto& b = by_grid.planes[i].plane;
    EXPECT_GT(a.normal.dot(b.normal), 1 - 1e-8);
    EXPECT_NEAR(a.offset, b.offset, 1e-4);
    EXPECT_NEAR(a.area, b.area, 0.02 * a.area);
  }
}

TEST(PlaneCloud, KnowsNeighboursByTheGridAlone)
{
  // Two sheets 1 mm apart, in columns that do not touch: close in space, not on the grid.
  constexpr std::size_t kWidth = 41;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  pcl6d::Points points;
  for (std::size_t row = 0; row < 20; ++row)
    for (std::size_t column = 0; column < kWidth; ++column) {
      const bool left = column < 20;
      const auto y = 0.1f * static_cast<float>(left ? column : column - 21);
      points.emplace_back(column == 20 ? nan
                          : left       ? 2.f
                                       : 2.001f,
                          y,
                          0.1f * static_cast<float>(row));
    }
  pcl6d::PlaneCloudOptions options;
  options.width = kWidth;
  options.voxel = 0.0005;
  const pcl6d::PlaneCloud cloud(points, options);
  const auto& surfels = cloud.surfels();
  ASSERT_EQ(surfels.size(), 800u);
  for (std::size_t i = 0; i < surfels.size(); ++i)
    for (std::size_t k = surfels.link_begin[i]; k < surfels.link_begin[i + 1]; ++k) {
      const auto own = cloud.places()[surfels.members[surfels.begin[i]]] % kWidth;
      const auto other =
          cloud.places()[surfels.members[surfels.begin[surfels.links[k]]]] % kWidth;
      EXPECT_EQ(own < 20, other < 20);
    }
}
