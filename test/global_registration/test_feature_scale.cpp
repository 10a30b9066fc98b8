// SPDX-License-Identifier: BSD-3-Clause
// Sizes of normals and descriptors from a cloud: laws of scale, the scanner of a room, lines
// of a spinning scanner, and what is too little.
#include "support/points.h"
#include "support/room.h"
#include "verification/verified_rooms.h"

#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/global_registration/feature_scale.h>
#include <pcl6d/search/point_tree.h>

#include <gtest/gtest.h>

using pcl6d::estimateFeatureScales;
using pcl6d::FeatureScale;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::test::badArgumentOf;
using pcl6d::test::PillarRoom;
using pcl6d::test::ScannedPair;

namespace {
Points
roomScan(double step = 0.025)
{
  Random random(3);
  return PillarRoom().scan(Eigen::Isometry3d::Identity(), random, step);
}

Points
reduced(const Points& points, double voxel)
{
  pcl6d::ReductionOptions options;
  options.voxel = voxel;
  return pcl6d::reducePoints(points, options);
}
} // namespace

TEST(FeatureScale, OfARoomHasEnoughPointsAndIsSmall)
{
  const Points scan = roomScan();
  const auto scales = estimateFeatureScales(scan);
  ASSERT_EQ(scales.size(), 1u);
  const FeatureScale& scale = scales[0];
  EXPECT_NE(scale.why, "");
  // Walls are 4 to 7 m away: a descriptor sees a part of a wall, a normal less of it.
  EXPECT_GT(scale.feature_radius, 0.3);
  EXPECT_LT(scale.feature_radius, 2);
  EXPECT_LT(scale.voxel, scale.normal_radius);
  EXPECT_LT(scale.normal_radius, scale.feature_radius);
  const Points points = reduced(scan, scale.voxel);
  const pcl6d::PointTree tree(points, 1);
  std::size_t enough = 0;
  const auto radius = static_cast<float>(scale.normal_radius);
  for (const auto& p : points)
    enough += tree.withinRadius(p, radius * radius).size() > 10;
  EXPECT_GT(2 * enough, points.size());
}

TEST(FeatureScale, GrowsWithTheUnit)
{
  const Points scan = roomScan();
  const auto metres = estimateFeatureScales(scan, 3);
  const auto other = estimateFeatureScales(ScannedPair::scaled(scan, 16), 3);
  ASSERT_EQ(other.size(), metres.size());
  for (std::size_t k = 0; k < metres.size(); ++k) // voxels have two digits: within 5 %
    EXPECT_NEAR(other[k].feature_radius / metres[k].feature_radius, 16, 0.8);
}

TEST(FeatureScale, EachIsTwiceTheOneBefore)
{
  const auto scales = estimateFeatureScales(roomScan(0.008), 10);
  ASSERT_GE(scales.size(), 2u);
  EXPECT_LT(scales.size(), 10u) << "none is as large as the room";
  for (std::size_t k = 1; k < scales.size(); ++k) {
    EXPECT_DOUBLE_EQ(scales[k].voxel, 2 * scales[k - 1].voxel);
    EXPECT_GT(scales[k].feature_radius, 1.5 * scales[k - 1].feature_radius);
  }
  EXPECT_LT(scales.back().feature_radius, 6);
}

TEST(FeatureScale, ReachesTheNextLineOfASparseScanner)
{
  // Sixteen lines 2 deg apart, points 0.2 deg apart along them, as on a wall 10 m away.
  Points lines;
  for (int line = -8; line < 8; ++line)
    for (int i = -300; i < 300; ++i)
      lines.emplace_back(10, 0.035f * static_cast<float>(i), 0.35f * line);
  const auto scales = estimateFeatureScales(lines);
  ASSERT_EQ(scales.size(), 1u);
  EXPECT_GT(scales[0].normal_radius, 0.35);
}

TEST(FeatureScale, OfAFewPointsThereIsNone)
{
  EXPECT_TRUE(estimateFeatureScales({}).empty());
  EXPECT_TRUE(estimateFeatureScales({{1, 2, 3}}).empty());
  EXPECT_TRUE(estimateFeatureScales(Points(50, {1, 2, 3})).empty());
  EXPECT_TRUE(estimateFeatureScales(Points(50, {pcl6d::test::kNan, 2, 3})).empty());
  EXPECT_NE(badArgumentOf([] { estimateFeatureScales({}, 0); }), "");
}
