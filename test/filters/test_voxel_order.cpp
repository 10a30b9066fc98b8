// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"
#include "support/points.h"
#include "support/poses.h"
#include "support/room.h"

#include <pcl6d/common/random.h>
#include <pcl6d/filters/pcl/octree_reduction.h>

#include <pcl/common/centroid.h>

#include <cmath>
#include <map>

using pcl6d::Points;
using pcl6d::Random;
using pcl6d::ReductionMethod;
using pcl6d::ReductionOptions;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;

// The reduction by its definition: a map from voxel to indices. The library sorts short
// keys by their digits instead, and must give the same bits in the same order.
namespace {
using Groups = std::map<pcl6d::VoxelKey, pcl::Indices>;

Groups
groupsOf(const Points& points, double voxel)
{
  Groups groups;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (points[i].allFinite())
      groups[pcl6d::voxelKey(points[i], voxel)].push_back(static_cast<int>(i));
  return groups;
}

Eigen::Vector3f
meanOf(const Points& points, const pcl::Indices& indices)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto i : indices)
    sum += points[i].cast<double>();
  return (sum / static_cast<double>(indices.size())).cast<float>();
}

pcl::Indices
chosenFrom(pcl6d::VoxelKey key, pcl::Indices indices, const ReductionOptions& options)
{
  const auto count = static_cast<std::size_t>(options.points_per_voxel);
  if (indices.size() <= count)
    return indices;
  std::uint64_t bits = pcl6d::mixBits(key ^ pcl6d::mixBits(options.seed));
  for (std::size_t i = 0; i < count; ++i) {
    bits = pcl6d::mixBits(bits);
    std::swap(indices[i], indices[i + bits % (indices.size() - i)]);
  }
  indices.resize(count);
  std::sort(indices.begin(), indices.end());
  return indices;
}

Points
reducedByDefinition(const Points& points, const ReductionOptions& options)
{
  Points reduced;
  for (const auto& [key, indices] : groupsOf(points, options.voxel))
    if (options.method == ReductionMethod::kCentre)
      reduced.push_back(pcl6d::voxelCentre(key, options.voxel));
    else if (options.method == ReductionMethod::kMean)
      reduced.push_back(meanOf(points, indices));
    else
      for (const auto i : chosenFrom(key, indices, options))
        reduced.push_back(points[i]);
  return reduced;
}

void
expectTheDefinition(const Points& points, double voxel)
{
  SCOPED_TRACE("voxel [m] " + std::to_string(voxel));
  ReductionOptions options;
  options.voxel = voxel;
  options.seed = 7;
  for (const auto method :
       {ReductionMethod::kCentre, ReductionMethod::kMean, ReductionMethod::kRandom})
    for (const int count : {1, 3}) {
      options.method = method;
      options.points_per_voxel = count;
      pcl6d::test::expectSamePoints(pcl6d::reducePoints(points, options),
                                    reducedByDefinition(points, options));
    }
}

Points
roomScan()
{
  Random random(5);
  const Eigen::Isometry3d pose(Eigen::Translation3d(0.3, -0.2, 0.1));
  return pcl6d::test::PillarRoom().scan(pose, random, 0.03);
}
} // namespace

TEST(VoxelOrder, IsThatOfTheDefinitionInAScan)
{
  const Points scan = roomScan();
  ASSERT_GT(scan.size(), 5000u);
  for (const double voxel : {0.003, 0.02, 0.1, 0.3, 1.0 / 3, 2.0, 1000.0})
    expectTheDefinition(scan, voxel);
}

TEST(VoxelOrder, IsThatOfTheDefinitionForPointsInAnyOrder)
{
  Random random(6);
  // 2 000 points leave 3 x 21 - 10 bits: these extents need short and long keys.
  for (const double extent : {1e-3, 1.0, 100.0, 1e4, 1.5e5})
    expectTheDefinition(pcl6d::test::randomCube(random, 2000, extent), 0.1);
}

TEST(VoxelOrder, IsThatOfTheDefinitionOnTheBordersOfVoxels)
{
  Points points;
  for (const double voxel : {0.1, 0.3}) {
    points.clear();
    for (int i = -2000; i < 2000; ++i)
      for (const double ulps : {-1.0, 0.0, 1.0}) {
        const double border = i * voxel * (1 + ulps * 0x1.0p-24);
        points.push_back(Eigen::Vector3d(border, -border, 0).cast<float>());
      }
    expectTheDefinition(points, voxel);
  }
}

TEST(VoxelOrder, IsThatOfTheDefinitionFromOneEdgeOfTheGridToTheOther)
{
  const float edge =
      0.5f * (1 << 20); // [m] 21 bits an axis; the upper end lies outside
  const float last = std::nextafter(edge, 0.0f);
  expectTheDefinition({{-edge, -edge, -edge}, {last, last, last}, {0, -0.0f, 1}}, 0.5);
  expectTheDefinition({{last, 0, 0}, {-edge, 0, 0}, {1, 0, 0}}, 0.5);
}

TEST(VoxelOrder, LeavesOutPointsOfWhichAnyCoordinateIsNotFinite)
{
  Points points = roomScan();
  for (std::size_t i = 0; i < points.size(); i += 7)
    points[i][static_cast<int>(i % 3)] = kNan;
  expectTheDefinition(points, 0.1);
  points[1].x() = kInfinity;
  points[2].y() = -kInfinity;
  points[3] = {1e30f, kNan, 0}; // far, but no point
  expectTheDefinition(points, 0.1);
}

TEST(VoxelOrder, HoldsForCloudsOfAnySmallSize)
{
  Random random(8); // sizes on both sides of the four lanes and of the block
  for (const std::size_t size : {0, 1, 2, 3, 4, 5, 511, 512, 513})
    expectTheDefinition(pcl6d::test::randomCube(random, size, 3), 0.25);
  expectTheDefinition(Points(700, {1, 2, 3}), 0.25);
}

TEST(VoxelOrder, NamesTheFirstPointOutsideTheGrid)
{
  const auto message = pcl6d::test::badArgumentOf([] {
    pcl6d::reducePoints({{1, 2, 3}, {2e5f, 0, 4}, {3e5f, 0, 0}}, ReductionOptions());
  });
  EXPECT_NE(message.find("point (200000, 0, 4) lies outside"), std::string::npos)
      << message;
}

TEST(VoxelOrder, AveragesAllFieldsOfTheMembersInTheirOrder)
{
  const auto cloud = pcl6d::test::toCloud<pcl::PointXYZINormal>(roomScan());
  Random random(9);
  for (auto& p : *cloud) {
    p.intensity = static_cast<float>(random.uniform(0, 100));
    p.curvature = static_cast<float>(random.uniform());
    p.normal_x = static_cast<float>(random.normal());
  }
  pcl6d::OctreeReduction<pcl::PointXYZINormal> reduction;
  reduction.options().voxel = 0.2;
  reduction.setInputCloud(cloud);
  pcl::PointCloud<pcl::PointXYZINormal> found;
  reduction.filter(found);
  const Groups groups = groupsOf(pcl6d::toPoints(*cloud), 0.2);
  ASSERT_EQ(found.size(), groups.size());
  std::size_t at = 0;
  for (const auto& [key, indices] : groups) {
    pcl::CentroidPoint<pcl::PointXYZINormal> mean;
    for (const auto i : indices)
      mean.add((*cloud)[i]);
    pcl::PointXYZINormal expected;
    mean.get(expected);
    EXPECT_EQ(found[at].intensity, expected.intensity);
    EXPECT_EQ(found[at].curvature, expected.curvature);
    EXPECT_EQ(found[at].normal_x, expected.normal_x);
    ++at;
  }
}
