// SPDX-License-Identifier: BSD-3-Clause
#include "support/constants.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/filters/map_builder.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <cstring>
#include <set>

using pcl6d::MapBuilder;
using pcl6d::Points;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kIdentity;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;

TEST(MapBuilder, KeepsTheFirstPointOfEachVoxel)
{
  MapBuilder map(0.5);
  map.addScan(
      {{0.1f, 0, 0}, {0.4f, 0, 0}, {0.6f, 0, 0}, {-0.1f, 0, 0}}, {}, kIdentity, 3);
  map.addScan({{0.2f, 0, 0}, {1.1f, 0, 0}}, {}, kIdentity, 7);
  EXPECT_EQ(map.points(),
            (Points{{0.1f, 0, 0}, {0.6f, 0, 0}, {-0.1f, 0, 0}, {1.1f, 0, 0}}));
  EXPECT_EQ(map.scans(), (std::vector<std::uint32_t>{3, 3, 3, 7}));
}

TEST(MapBuilder, LooksAtTheVoxelsOfTheWorld)
{
  // In their own frames the points coincide; in the world they are 1 m apart.
  MapBuilder map(0.5);
  map.addScan({{0.1f, 0.1f, 0.1f}}, {}, kIdentity, 0);
  map.addScan({{0.1f, 0.1f, 0.1f}}, {}, pcl6d::poseFromEuler({1, 0, 0}, {}), 1);
  map.addScan({{0.1f, -0.1f, 0.1f}}, {}, pcl6d::planarPose(0, 0, M_PI / 2), 2);
  ASSERT_EQ(map.points().size(), 2u) << "the third falls into the voxel of the first";
  EXPECT_FLOAT_EQ(map.points()[1].x(), 1.1f);
}

TEST(MapBuilder, CountsVoxelsFromTheWholeMetresOfTheFirstScan)
{
  MapBuilder map(0.3, {1, 2, 3}); // a metre is no whole number of voxels
  map.addScan({{0.05f, 0, 0}, {0.25f, 0, 0}, {0.35f, 0, 0}},
              {},
              pcl6d::poseFromEuler({8, 0, 0}, {}),
              0);
  EXPECT_EQ(map.points(), (Points{{7.05f, -2, -3}, {7.35f, -2, -3}}));
  map.addScan({{1.35f, 0, 0}, {2.05f, 0, 0}},
              {},
              pcl6d::poseFromEuler({6.9, 0, 0}, {}),
              1); // 8.25 m and 8.95 m
  ASSERT_EQ(map.points().size(), 3u) << "the same voxels for every scan";
  EXPECT_NEAR(map.points()[2].x(), 7.95, 1e-6);
}

TEST(MapBuilder, MapsAMillimetreFarFromTheOriginAsAtTheOrigin)
{
  pcl6d::Random random(4);
  const Points object = pcl6d::test::randomCube(random, 3000, 1e-3);
  constexpr double kVoxel = 1e-4; // [m] the grid reaches 105 m
  MapBuilder near(kVoxel), far(kVoxel);
  for (std::uint32_t scan = 0; scan < 2; ++scan) {
    const double x = 3e-4 * scan;
    near.addScan(object, {}, pcl6d::poseFromEuler({x, 0, 0}, {}), scan);
    far.addScan(object, {}, pcl6d::poseFromEuler({500 + x, 0, 0}, {}), scan);
  }
  EXPECT_GT(near.points().size(), 1000u);
  EXPECT_EQ(far.scans(), near.scans()) << "the same points";
}

TEST(MapBuilder, KeepsOnePointPerVoxelWhereverTheFirstScanIs)
{
  pcl6d::Random random(8);
  constexpr double kVoxel = 0.25; // [m] exact, so that no rounding moves a point
  for (int turn = 0; turn < 5; ++turn) {
    Eigen::Isometry3d pose = pcl6d::test::randomPose(random, 5000, 1);
    const Eigen::Vector3d offset = pose.translation().array().round();
    MapBuilder map(kVoxel, offset);
    std::set<pcl6d::VoxelKey> all, kept;
    for (std::uint32_t scan = 0; scan < 3; ++scan) {
      const Points points = pcl6d::test::randomCube(random, 2000, 4);
      map.addScan(points, {}, pose, scan);
      Eigen::Isometry3d relative = pose;
      relative.translation() -= offset;
      for (const auto& p : pcl6d::transformed(points, relative))
        all.insert(pcl6d::voxelKey(p, kVoxel));
      pose.translation().x() += 1.3;
    }
    for (const auto& p : map.points())
      EXPECT_TRUE(kept.insert(pcl6d::voxelKey(p, kVoxel)).second);
    EXPECT_EQ(kept, all);
  }
}

TEST(MapBuilder, SubtractsTheOffsetInDouble)
{
  const Eigen::Vector3d offset(691235, 5336789, 512);
  Eigen::Isometry3d pose = pcl6d::planarPose(0, 0, 0.3);
  pose.translation() = offset + Eigen::Vector3d(0.123456789, 1, 2);
  MapBuilder map(0.1, offset);
  map.addScan({{0, 0, 0}}, {}, pose, 0);
  // The pose is known to 1e-9 m, the point to the rounding of 2 m to float.
  EXPECT_LT((map.points()[0] - Eigen::Vector3f(0.123456789f, 1, 2)).norm(), 2e-7f);
}

TEST(MapBuilder, LeavesOutPointsThatAreNotFinite)
{
  MapBuilder map(0.5);
  map.addScan({{kNan, 0, 0}, {1, 1, 1}, {0, kInfinity, 0}}, {1, 2, 3}, kIdentity, 0);
  EXPECT_EQ(map.points(), (Points{{1, 1, 1}}));
}

TEST(MapBuilder, MakesACloudWithScanAndIntensity)
{
  MapBuilder map(0.5);
  map.addScan({{1, 2, 3}, {1, 2, 3}}, {10, 20}, kIdentity, 4);
  map.addScan({{-4, -5, -6}}, {30}, kIdentity, 70000);
  const pcl::PCLPointCloud2 cloud = map.cloud();
  ASSERT_EQ(cloud.fields.size(), 5u);
  const char* names[] = {"x", "y", "z", "scan", "intensity"};
  for (std::uint32_t i = 0; i < 5; ++i) {
    EXPECT_EQ(cloud.fields[i].name, names[i]);
    EXPECT_EQ(cloud.fields[i].offset, 4 * i);
    EXPECT_EQ(cloud.fields[i].count, 1u);
    EXPECT_EQ(cloud.fields[i].datatype,
              i == 3 ? pcl::PCLPointField::UINT32 : pcl::PCLPointField::FLOAT32);
  }
  EXPECT_EQ(cloud.width, 2u);
  EXPECT_EQ(cloud.height, 1u);
  EXPECT_EQ(cloud.point_step, 20u);
  EXPECT_EQ(cloud.row_step, 40u);
  ASSERT_EQ(cloud.data.size(), 40u);
  EXPECT_TRUE(cloud.is_dense);
  std::uint32_t scan;
  std::memcpy(&scan, cloud.data.data() + 20 + 12, 4);
  EXPECT_EQ(scan, 70000u);

  pcl::PointCloud<pcl::PointXYZI> points; // PCL reads it
  pcl::fromPCLPointCloud2(cloud, points);
  EXPECT_EQ(points[0].getVector3fMap(), Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(points[0].intensity, 10);
  EXPECT_EQ(points[1].getVector3fMap(), Eigen::Vector3f(-4, -5, -6));
  EXPECT_EQ(points[1].intensity, 30);
}

TEST(MapBuilder, HasIntensityOnlyIfEveryScanHadIt)
{
  for (const bool first : {true, false}) {
    MapBuilder map(0.5);
    map.addScan({{1, 2, 3}},
                first ? std::vector<float>{1} : std::vector<float>(),
                kIdentity,
                0);
    map.addScan({{4, 5, 6}},
                first ? std::vector<float>() : std::vector<float>{1},
                kIdentity,
                1);
    const pcl::PCLPointCloud2 cloud = map.cloud();
    EXPECT_EQ(cloud.fields.size(), 4u);
    EXPECT_EQ(cloud.point_step, 16u);
    EXPECT_EQ(cloud.data.size(), 32u);
  }
}

TEST(MapBuilder, MakesAnEmptyCloudOfNothing)
{
  const pcl::PCLPointCloud2 cloud = MapBuilder(0.5).cloud();
  EXPECT_EQ(cloud.width, 0u);
  EXPECT_TRUE(cloud.data.empty());
}

TEST(MapBuilder, RefusesWhatBreaksItsRules)
{
  for (const double voxel : {0.0, -1.0, double{kNan}, double{kInfinity}})
    EXPECT_EQ(badArgumentOf([&] { MapBuilder map(voxel); }).find("voxel = "), 0u);
  EXPECT_EQ(badArgumentOf([&] { MapBuilder map(kInfinity); }),
            "voxel = inf, but must be finite and > 0");
  MapBuilder map(0.5);
  EXPECT_THROW(map.addScan({{1, 2, 3}}, {1, 2}, kIdentity, 0), pcl6d::BadArgument);
  EXPECT_TRUE(map.points().empty());
}

TEST(MapBuilder, TakesItsGridFromTheFirstScanThatIsNotRefused)
{
  MapBuilder map(0.5);
  EXPECT_THROW(map.addScan({{1e9f, 0, 0}}, {}, kIdentity, 0), pcl6d::BadArgument);
  EXPECT_NO_THROW(
      map.addScan({{1, 0, 0}}, {}, pcl6d::poseFromEuler({1e7, 0, 0}, {}), 0));
}

TEST(MapBuilder, IsAsBeforeWhenAScanIsRefused)
{
  MapBuilder map(0.5);
  map.addScan({{1, 2, 3}}, {5}, kIdentity, 0);
  EXPECT_THROW(map.addScan({{4, 5, 6}, {1e9f, 0, 0}}, {}, kIdentity, 1),
               pcl6d::BadArgument);
  EXPECT_EQ(map.points().size(), 1u);
  EXPECT_EQ(map.cloud().fields.size(), 5u) << "still with intensity";
  map.addScan({{4, 5, 6}}, {6}, kIdentity, 1);
  EXPECT_EQ(map.points().size(), 2u) << "the voxel is free";
}
