// SPDX-License-Identifier: BSD-3-Clause
#include "support/clouds.h"
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/filters/pcl/octree_reduction.h>

#include <cmath>

using pcl6d::OctreeReduction;
using pcl6d::Points;
using pcl6d::ReductionMethod;
using pcl6d::test::kNan;
using pcl6d::test::toCloud;

namespace {
constexpr double kOctreeVoxel = 0.5; // [m]

Points
samplePoints()
{
  pcl6d::Random random(1);
  return pcl6d::test::randomCube(random, 2000, 4);
}

template <typename PointT>
pcl::PointCloud<PointT>
reduced(const typename pcl::PointCloud<PointT>::ConstPtr& cloud, ReductionMethod method)
{
  OctreeReduction<PointT> reduction;
  reduction.options().voxel = kOctreeVoxel;
  reduction.options().method = method;
  reduction.setInputCloud(cloud);
  pcl::PointCloud<PointT> output;
  reduction.filter(output);
  return output;
}
} // namespace

template <typename PointT>
class OctreeReductionOf : public testing::Test {};
using PointTypes = testing::Types<pcl::PointXYZ,
                                  pcl::PointXYZI,
                                  pcl::PointXYZRGB,
                                  pcl::PointNormal,
                                  pcl::PointXYZINormal>;
TYPED_TEST_SUITE(OctreeReductionOf, PointTypes);

TYPED_TEST(OctreeReductionOf, GivesThePointsOfTheCore)
{
  const Points points = samplePoints();
  for (const auto method :
       {ReductionMethod::kCentre, ReductionMethod::kMean, ReductionMethod::kRandom}) {
    SCOPED_TRACE(static_cast<int>(method));
    pcl6d::ReductionOptions options;
    options.voxel = kOctreeVoxel;
    options.method = method;
    const Points expected = pcl6d::reducePoints(points, options);
    const Points found =
        pcl6d::toPoints(reduced<TypeParam>(toCloud<TypeParam>(points), method));
    pcl6d::test::expectSamePoints(found, expected);
  }
}

TEST(OctreeReduction, AveragesInDouble)
{
  // Summing 20 000 points in float, 100 m from the origin, is off by centimetres.
  pcl6d::Random random(2);
  Points points(20000);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (auto& p : points) {
    p = Eigen::Vector3d(100 + random.uniform(0, 0.49), 0.1, 0.1).cast<float>();
    sum += p.cast<double>();
  }
  const auto output =
      reduced<pcl::PointXYZ>(toCloud<pcl::PointXYZ>(points), ReductionMethod::kMean);
  ASSERT_EQ(output.size(), 1u);
  constexpr double kFloatUlp = 7.7e-6; // [m] of coordinates from 64 to 128 m
  EXPECT_NEAR(output[0].x, sum.x() / points.size(), kFloatUlp);
}

TEST(OctreeReduction, AveragesIntensities)
{
  auto cloud = toCloud<pcl::PointXYZI>({{0.1f, 0, 0}, {0.2f, 0, 0}, {-0.1f, 0, 0}});
  (*cloud)[0].intensity = 10;
  (*cloud)[1].intensity = 30;
  (*cloud)[2].intensity = 7;
  auto output = reduced<pcl::PointXYZI>(cloud, ReductionMethod::kMean);
  ASSERT_EQ(output.size(), 2u);
  EXPECT_EQ(output[output[0].x < 0 ? 0 : 1].intensity, 7);
  EXPECT_EQ(output[output[0].x < 0 ? 1 : 0].intensity, 20);

  output = reduced<pcl::PointXYZI>(cloud, ReductionMethod::kCentre);
  EXPECT_EQ(output[output[0].x < 0 ? 1 : 0].intensity, 10) << "of the first point";
}

TEST(OctreeReduction, ReducesOnlyTheChosenPoints)
{
  const Points points = samplePoints();
  auto indices = pcl::make_shared<pcl::Indices>();
  Points chosen;
  for (int i = 1999; i >= 0; i -= 3) {
    indices->push_back(i);
    chosen.push_back(points[i]);
  }
  for (const auto method :
       {ReductionMethod::kCentre, ReductionMethod::kMean, ReductionMethod::kRandom}) {
    OctreeReduction<pcl::PointXYZ> reduction;
    reduction.options().voxel = kOctreeVoxel;
    reduction.options().method = method;
    reduction.setInputCloud(toCloud<pcl::PointXYZ>(points));
    reduction.setIndices(indices);
    pcl::PointCloud<pcl::PointXYZ> output;
    reduction.filter(output);
    pcl6d::test::expectSamePoints(pcl6d::toPoints(output),
                                  pcl6d::reducePoints(chosen, reduction.options()));
  }
}

TEST(OctreeReduction, GivesADenseCloudWithTheHeaderOfTheInput)
{
  Points points = samplePoints();
  points[3].x() = kNan;
  const auto cloud = toCloud<pcl::PointXYZ>(points);
  cloud->header.frame_id = "scanner";
  cloud->header.stamp = 12345;
  cloud->sensor_origin_ << 1, 2, 3, 1;
  const auto output = reduced<pcl::PointXYZ>(cloud, ReductionMethod::kMean);
  EXPECT_EQ(output.header.frame_id, "scanner");
  EXPECT_EQ(output.header.stamp, 12345u);
  EXPECT_EQ(output.sensor_origin_, cloud->sensor_origin_);
  EXPECT_TRUE(output.is_dense);
  EXPECT_EQ(output.width, output.size());
  EXPECT_EQ(output.height, 1u);
  for (const auto& p : output)
    EXPECT_TRUE(p.getVector3fMap().allFinite());
}

TEST(OctreeReduction, FiltersInPlace)
{
  const auto cloud = toCloud<pcl::PointXYZ>(samplePoints());
  const auto expected = reduced<pcl::PointXYZ>(cloud, ReductionMethod::kMean);
  OctreeReduction<pcl::PointXYZ> reduction;
  reduction.options().voxel = kOctreeVoxel;
  reduction.setInputCloud(cloud);
  reduction.filter(*cloud);
  pcl6d::test::expectSamePoints(pcl6d::toPoints(*cloud), pcl6d::toPoints(expected));
}

TEST(OctreeReduction, RefusesBadOptionsAndPointsOutsideTheGrid)
{
  OctreeReduction<pcl::PointXYZ> reduction;
  pcl::PointCloud<pcl::PointXYZ> output;
  reduction.setInputCloud(toCloud<pcl::PointXYZ>({{1, 2, 3}, {1e7f, 0, 0}}));
  EXPECT_THROW(reduction.filter(output), pcl6d::BadArgument); // 1e8 voxels away
  reduction.options().voxel = -1;
  EXPECT_THROW(reduction.filter(output), pcl6d::BadArgument);
}
