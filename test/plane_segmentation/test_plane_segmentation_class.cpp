// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces.h"

#include <pcl6d/common/error.h>
#include <pcl6d/plane_segmentation/pcl/plane_segmentation.h>

#include <gtest/gtest.h>

namespace {
using namespace pcl6d;

template <typename PointT>
class PlaneSegmentationOf : public testing::Test {};
using PointTypes = testing::Types<pcl::PointXYZ,
                                  pcl::PointXYZI,
                                  pcl::PointXYZRGB,
                                  pcl::PointNormal,
                                  pcl::PointXYZINormal>;

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
toCloud(const Points& points)
{
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (const auto& p : points) {
    cloud->push_back(PointT());
    cloud->back().getVector3fMap() = p;
  }
  return cloud;
}
} // namespace
TYPED_TEST_SUITE(PlaneSegmentationOf, PointTypes);

TYPED_TEST(PlaneSegmentationOf, AnswersTheCallsOfPclsClasses)
{
  RegionGrowingPlaneSegmentation<TypeParam> segmentation;
  segmentation.setInputCloud(toCloud<TypeParam>(test::room(0.01, 0.06)));
  std::vector<pcl::ModelCoefficients> coefficients;
  std::vector<pcl::PointIndices> inliers;
  segmentation.segment(coefficients, inliers);
  ASSERT_EQ(coefficients.size(), 6u);
  ASSERT_EQ(inliers.size(), 6u);
  for (const auto& plane : coefficients)
    EXPECT_GT(plane.values[3], 0.9f); // the origin is on the side of the normal
  pcl::PointIndices largest;
  pcl::ModelCoefficients plane;
  segmentation.segment(largest, plane);
  EXPECT_EQ(largest.indices, inliers[0].indices);
  EXPECT_EQ(plane.values, coefficients[0].values);
}

TEST(PlaneSegmentation, LooksAtTheChosenPointsOnly)
{
  test::Surfaces surfaces;
  const auto floor = surfaces.add({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, 0.04);
  const auto wall = surfaces.add({1, -1, -1}, {0, 2, 0}, {0, 0, 2}, 0.04);
  RegionGrowingPlaneSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setInputCloud(toCloud<pcl::PointXYZ>(surfaces.points()));
  segmentation.setIndices(pcl::make_shared<pcl::Indices>(wall.begin(), wall.end()));
  PlaneSegments found;
  segmentation.segment(found);
  ASSERT_EQ(found.planes.size(), 1u);
  EXPECT_EQ(found.planes[0].points, wall);
  EXPECT_TRUE(found.unassigned.empty());
}

TEST(PlaneSegmentation, TellsWhatIsWrong)
{
  RegionGrowingPlaneSegmentation<pcl::PointXYZ> segmentation;
  PlaneSegments found;
  EXPECT_THROW(segmentation.segment(found), BadArgument);
  segmentation.setInputCloud(toCloud<pcl::PointXYZ>(test::room(0, 0.2)));
  segmentation.setIndices(pcl::make_shared<pcl::Indices>(pcl::Indices{1 << 20}));
  EXPECT_THROW(segmentation.segment(found), BadArgument);
  segmentation.setInputCloud(pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>());
  segmentation.setIndices(pcl::make_shared<pcl::Indices>());
  segmentation.segment(found);
  EXPECT_TRUE(found.planes.empty());
}
