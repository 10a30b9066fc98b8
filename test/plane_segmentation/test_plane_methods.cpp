// SPDX-License-Identifier: BSD-3-Clause
// Each method from the cloud to the finished planes.
#include "plane_scenes.h"

#include <pcl6d/plane_segmentation/pcl/plane_segmentation.h>

#include <gtest/gtest.h>

#include <limits>

namespace {
using pcl6d::PlaneCloud;
using pcl6d::PlaneMethod;
using pcl6d::Points;

class PlaneMethods : public testing::TestWithParam<PlaneMethod> {};

TEST_P(PlaneMethods, FindTheFacesOfACubeAndTheirPoints)
{
  constexpr std::size_t kFacePoints = 3000;
  const Points points = pcl6d::test::noisyCube(4, kFacePoints, 0.02, 5);
  const auto found = pcl6d::segmentPlanes(PlaneCloud(points), GetParam());
  ASSERT_EQ(found.planes.size(), 6u);
  for (const auto& segment : found.planes) {
    EXPECT_NEAR(segment.plane.offset, 2, 0.005);
    EXPECT_NEAR(segment.plane.normal.cwiseAbs().maxCoeff(), 1, 1e-5);
    EXPECT_GT(segment.points.size(), 0.9 * kFacePoints);
  }
}

TEST_P(PlaneMethods, FindNothingWhereThereIsNoPlane)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const auto& points : {Points(),
                             Points{{1, 0, 0}, {0, 1, 0}},
                             Points(100, {nan, nan, nan}),
                             Points(100, {1, 2, 3}),
                             pcl6d::test::sphere(1, 5000, 1)}) {
    const PlaneCloud cloud(points);
    const auto found = pcl6d::segmentPlanes(cloud, GetParam());
    EXPECT_TRUE(found.planes.empty());
    EXPECT_EQ(found.unassigned.size(), cloud.points().size());
  }
}

INSTANTIATE_TEST_SUITE_P(All,
                         PlaneMethods,
                         testing::Values(PlaneMethod::kRegionGrowing,
                                         PlaneMethod::kRansac,
                                         PlaneMethod::kHough));

/** \return what the PCL class finds */
template <template <typename> class Segmentation>
pcl6d::PlaneSegments
segmentedBy(const Points& points)
{
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const auto& p : points)
    cloud->emplace_back(p.x(), p.y(), p.z());
  Segmentation<pcl::PointXYZ> segmentation;
  segmentation.setInputCloud(cloud);
  pcl6d::PlaneSegments found;
  segmentation.segment(found);
  return found;
}

TEST(PlaneSegmentationClasses, GiveWhatTheCoreGives)
{
  const Points points = pcl6d::test::noisyCube(4, 1000, 0.01, 5);
  const PlaneCloud cloud(points);
  const auto by_ransac = segmentedBy<pcl6d::RansacPlaneSegmentation>(points);
  const auto by_hough = segmentedBy<pcl6d::HoughPlaneSegmentation>(points);
  ASSERT_EQ(by_ransac.planes.size(), 6u);
  ASSERT_EQ(by_hough.planes.size(), 6u);
  const auto ransac = pcl6d::segmentPlanes(cloud, PlaneMethod::kRansac);
  const auto hough = pcl6d::segmentPlanes(cloud, PlaneMethod::kHough);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(by_ransac.planes[i].points, ransac.planes[i].points);
    EXPECT_EQ(by_hough.planes[i].points, hough.planes[i].points);
  }
}
} // namespace
