// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces.h"

#include <pcl6d/common/error.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {
using namespace pcl6d;

void
expectNone(const Points& points)
{
  const auto found = segmentPlanes(PlaneCloud(points));
  EXPECT_TRUE(found.planes.empty());
  std::size_t finite = 0;
  for (const auto& p : points)
    finite += p.allFinite();
  EXPECT_EQ(found.unassigned.size(), finite);
}

Points
line(std::size_t size)
{
  Points points;
  for (std::size_t i = 0; i < size; ++i)
    points.emplace_back(1.f, 0.01f * static_cast<float>(i), 2.f);
  return points;
}
} // namespace

TEST(SegmentPlanesBadInput, FewPointsMakeNoPlane)
{
  for (const std::size_t size : {0, 1, 2, 3, 4, 49}) {
    SCOPED_TRACE(size);
    expectNone(line(size));
    expectNone(Points(size, Eigen::Vector3f(1, 2, 3))); // all in one place
  }
}

TEST(SegmentPlanesBadInput, PointsOnALineMakeNoPlane)
{
  expectNone(line(5000));
}

TEST(SegmentPlanesBadInput, PointsThatAreNotFiniteAreLeftOut)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  expectNone(Points(1000, Eigen::Vector3f(nan, nan, nan)));
  test::Surfaces surfaces;
  surfaces.add({2, -1, -1}, {0, 2, 0}, {0, 0, 2}, 0.05);
  Points points(7, Eigen::Vector3f(nan, 0, 0));
  points.insert(points.end(), surfaces.points().begin(), surfaces.points().end());
  const auto found = segmentPlanes(PlaneCloud(points));
  ASSERT_EQ(found.planes.size(), 1u);
  EXPECT_EQ(found.planes[0].points.front(), 7u);
  EXPECT_EQ(found.planes[0].points.size(), surfaces.points().size());
}

TEST(SegmentPlanesBadInput, ASphereIsNoPlane)
{
  for (const double radius : {0.3, 1.0, 5.0, 32.767}) {
    SCOPED_TRACE(radius);
    Random random(5);
    Points points;
    while (points.size() < 40000) {
      const Eigen::Vector3d p(random.normal(), random.normal(), random.normal());
      points.push_back((radius * p.normalized()).cast<float>());
    }
    expectNone(points);
  }
}

TEST(SegmentPlanesBadInput, SmallPlanesAreDropped)
{
  test::Surfaces surfaces;
  surfaces.add({2, 0, 0}, {0, 0.3, 0}, {0, 0, 0.3}, 0.01); // 0.09 m^2
  expectNone(surfaces.points());
  PlaneSegmentationOptions options;
  options.planes.min_area = 0.08;
  const PlaneCloud cloud(surfaces.points());
  EXPECT_EQ(segmentPlanes(cloud, PlaneMethod::kRegionGrowing, options).planes.size(),
            1u);
  options.planes.min_points = surfaces.points().size() + 1;
  EXPECT_TRUE(
      segmentPlanes(cloud, PlaneMethod::kRegionGrowing, options).planes.empty());
}

TEST(SegmentPlanesBadInput, OptionsThatBreakTheirRuleAreRefused)
{
  const PlaneCloud cloud(test::room(0, 0.2));
  const auto refused = [&](auto change) {
    PlaneSegmentationOptions options;
    change(options);
    EXPECT_THROW(segmentPlanes(cloud, PlaneMethod::kRegionGrowing, options),
                 BadArgument);
  };
  refused([](auto& o) { o.planes.min_area = -1; });
  refused([](auto& o) { o.planes.min_points = 2; });
  refused([](auto& o) { o.planes.max_plane_distance = 0; });
  refused([](auto& o) { o.planes.max_angle = 2; });
  refused([](auto& o) { o.planes.merge_gap = std::nan(""); });
  refused([](auto& o) { o.region_growing.max_rms = 0; });
  refused([](auto& o) { o.region_growing.max_angle = 0; });
  refused([](auto& o) { o.region_growing.min_surfels = 2; });
  refused([](auto& o) { o.region_growing.max_plane_distance = -1; });
  EXPECT_THROW(planeMethodFromName("magic"), BadArgument);
  for (const auto method :
       {PlaneMethod::kRegionGrowing, PlaneMethod::kRansac, PlaneMethod::kHough})
    EXPECT_EQ(planeMethodFromName(toString(method)), method);
}

TEST(ChoosePlaneMethod, TakesNamesAndThoseOfTheVariantsOfHough)
{
  for (const auto& word : planeMethodWords()) {
    PlaneSegmentationOptions options;
    const PlaneMethod method = choosePlaneMethod(word, options);
    if (method == PlaneMethod::kHough && word != toString(method)) {
      EXPECT_EQ(word, "hough-" + toString(options.hough.variant));
    }
    else {
      EXPECT_EQ(word, toString(method));
    }
  }
  EXPECT_EQ(planeMethodWords().size(), 3u + houghVariantNames().size());
  PlaneSegmentationOptions options;
  for (const char* const bad : {"", "hough-", "standard", "hough-magic"})
    EXPECT_THROW(choosePlaneMethod(bad, options), BadArgument) << bad;
  EXPECT_THROW(houghVariantFromName("magic"), BadArgument);
}

TEST(SegmentPlanesBadInput, ACloudThatDoesNotFitItsOptionsIsRefused)
{
  const auto refused = [](auto change) {
    PlaneCloudOptions options;
    change(options);
    EXPECT_THROW(PlaneCloud(test::room(0, 0.2), options), BadArgument);
  };
  refused([](auto& o) { o.viewpoint.x() = std::nanf(""); });
  refused([](auto& o) { o.viewpoints.resize(3); });
  refused([](auto& o) { o.width = 7919; });
  refused([](auto& o) { o.voxel = 0; });
  refused([](auto& o) { o.noise = -1; });
  refused([](auto& o) { o.distortion = -0.1; });
}
