// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces.h"

#include <pcl6d/plane_segmentation/segment_planes.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace {
using namespace pcl6d;
using Eigen::Vector3d;

PlaneSegments
segmented(const Points& points, unsigned int num_threads = 0)
{
  return segmentPlanes(PlaneCloud(points, num_threads));
}

/** The share of the places that a segment holds. */
double
shareOf(const std::vector<std::uint32_t>& places, const PlaneSegment& segment)
{
  std::vector<std::uint32_t> common;
  std::set_intersection(places.begin(),
                        places.end(),
                        segment.points.begin(),
                        segment.points.end(),
                        std::back_inserter(common));
  return static_cast<double>(common.size()) / static_cast<double>(places.size());
}

/** The segment with most of the places; all of it lies on the same plane. */
const PlaneSegment&
holderOf(const std::vector<std::uint32_t>& places, const PlaneSegments& found)
{
  return *std::max_element(found.planes.begin(),
                           found.planes.end(),
                           [&](const PlaneSegment& a, const PlaneSegment& b) {
                             return shareOf(places, a) < shareOf(places, b);
                           });
}
} // namespace

TEST(SegmentPlanes, FindsTheSixFacesOfARoomExactly)
{
  const auto points = test::room();
  const auto found = segmented(points);
  ASSERT_EQ(found.planes.size(), 6u);
  const double offsets[] = {1, 2, 1.5, 2.5, 2, 2}; // of floor, ceiling, y, y, x, x
  std::multiset<double> expected(std::begin(offsets), std::end(offsets)), seen;
  for (const auto& segment : found.planes) {
    const Plane& plane = segment.plane;
    EXPECT_NEAR(plane.normal.cwiseAbs().maxCoeff(), 1, 1e-6);
    seen.insert(std::round(plane.offset * 1e4) / 1e4);
    const double truth = std::abs(plane.normal.z()) > 0.9 ? 16 : 12;
    EXPECT_NEAR(plane.area, truth, 0.03 * truth); // the outline, made of cells
    EXPECT_LT(plane.rms, 1e-6);
    EXPECT_EQ(plane.inliers, segment.points.size());
    EXPECT_EQ(segment.outline.size(), 1u);
    EXPECT_LT(segment.seen_from.dot(plane.normal * plane.offset), 0); // from within
  }
  EXPECT_EQ(seen, expected);
  EXPECT_LT(found.unassigned.size(), points.size() / 100);
}

TEST(SegmentPlanes, KeepsTheRulesOfItsResult)
{
  const auto points = test::room(0.01);
  const auto found = segmented(points);
  ASSERT_EQ(found.planes.size(), 6u);
  std::vector<int> times(points.size(), 0);
  for (const auto i : found.unassigned)
    ++times[i];
  double area = 1e9;
  for (const auto& segment : found.planes) {
    EXPECT_LE(segment.plane.area, area);
    area = segment.plane.area;
    EXPECT_GE(segment.plane.offset, 0);
    EXPECT_NEAR(segment.plane.normal.norm(), 1, 1e-12);
    EXPECT_TRUE(std::is_sorted(segment.points.begin(), segment.points.end()));
    EXPECT_NEAR(segment.plane.rms, 0.01, 0.001);
    for (const auto i : segment.points)
      ++times[i];
    for (const auto& corner : segment.plane.hull)
      EXPECT_NEAR(segment.plane.normal.dot(corner), segment.plane.offset, 1e-9);
    Vector3d twice_area = Vector3d::Zero();
    const auto& ring = segment.outline.front();
    for (std::size_t i = 2; i < ring.size(); ++i)
      twice_area += (ring[i - 1] - ring[0]).cross(ring[i] - ring[0]);
    EXPECT_GT(twice_area.dot(segment.plane.normal), 0); // counter-clockwise
  }
  EXPECT_TRUE(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
}

TEST(SegmentPlanes, GivesTheSameBitsForAnyNumberOfThreads)
{
  const auto points = test::room(0.01, 0.05);
  const auto one = segmented(points, 1);
  for (const unsigned int threads : {2u, 8u}) {
    const auto many = segmented(points, threads);
    ASSERT_EQ(many.planes.size(), one.planes.size());
    for (std::size_t i = 0; i < one.planes.size(); ++i) {
      EXPECT_EQ(many.planes[i].points, one.planes[i].points);
      EXPECT_EQ(many.planes[i].plane.normal, one.planes[i].plane.normal);
      EXPECT_EQ(many.planes[i].plane.area, one.planes[i].plane.area);
      EXPECT_EQ(many.planes[i].outline, one.planes[i].outline);
    }
  }
}

TEST(SegmentPlanes, IsIndifferentToARigidMotionAndTheOrderOfPoints)
{
  const auto points = test::room(0.01);
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.linear() =
      Eigen::Quaterniond(0.9, 0.1, -0.3, 0.2).normalized().toRotationMatrix();
  motion.translation() << 3, -7, 1;
  Points moved = transformed(points, motion);
  std::reverse(moved.begin(), moved.end());
  PlaneCloudOptions options;
  options.viewpoint = motion.translation().cast<float>();
  const auto before = segmented(points);
  const auto after = segmentPlanes(PlaneCloud(moved, options));
  ASSERT_EQ(after.planes.size(), before.planes.size());
  for (const auto& segment : before.planes) {
    std::vector<std::uint32_t> places;
    for (const auto i : segment.points)
      places.insert(places.begin(), static_cast<std::uint32_t>(points.size()) - 1 - i);
    const auto& same = holderOf(places, after);
    EXPECT_GT(shareOf(places, same), 0.99); // voxels lie elsewhere
    EXPECT_GT(same.seen_from.dot(motion.linear() * segment.seen_from),
              std::cos(1e-3)); // far below the 0.1 deg that noise allows
  }
}

TEST(SegmentPlanes, ADoorInFrontOfTheWallStaysItsOwnPlane)
{
  test::Surfaces surfaces(0.01);
  const Vector3d left(0, -1, 0), up(0, 0, 1);
  auto wall = surfaces.add({3, 2, -1}, 1.5 * left, 2.5 * up, 0.03);
  const auto right = surfaces.add({3, -0.4, -1}, 1.6 * left, 2.5 * up, 0.03);
  const auto lintel = surfaces.add({3, 0.5, 1}, 0.9 * left, 0.5 * up, 0.03);
  const auto door = surfaces.add({2.95, 0.5, -1}, 0.9 * left, 2 * up, 0.03);
  wall.insert(wall.end(), right.begin(), right.end());
  wall.insert(wall.end(), lintel.begin(), lintel.end());
  const auto found = segmented(surfaces.points());
  ASSERT_EQ(found.planes.size(), 2u); // and the wall is one
  EXPECT_GT(shareOf(wall, found.planes[0]), 0.95);
  EXPECT_GT(shareOf(door, found.planes[1]), 0.95);
  EXPECT_NEAR(found.planes[1].plane.offset, 2.95, 0.002);
}

TEST(SegmentPlanes, WallsThatMeetDoNotEatEachOthersPoints)
{
  test::Surfaces surfaces(0.01);
  const auto a = surfaces.add({3, -2, -1}, {0, 4, 0}, {0, 0, 2}, 0.03);
  const auto b = surfaces.add({3, 2, -1}, {-4, 0, 0}, {0, 0, 2}, 0.03);
  const auto found = segmented(surfaces.points());
  ASSERT_EQ(found.planes.size(), 2u);
  for (const auto& wall : {a, b}) {
    const auto& segment = holderOf(wall, found);
    EXPECT_GT(shareOf(wall, segment), 0.98);
    EXPECT_LT(static_cast<double>(segment.points.size()), 1.02 * wall.size());
  }
}

TEST(SegmentPlanes, TheTwoFacesOfAWallAreTwoPlanes)
{
  test::Surfaces surfaces(0.005);
  const auto front = surfaces.add({2, -1, -1}, {0, 2, 0}, {0, 0, 2}, 0.03);
  const auto back = surfaces.add({2.3, -1, -1}, {0, 2, 0}, {0, 0, 2}, 0.03);
  PlaneCloudOptions options; // a map: each point has the place of its own scan
  options.viewpoints.assign(front.size(), {0, 0, 0});
  options.viewpoints.resize(surfaces.points().size(), {4, 0, 0});
  const auto found = segmentPlanes(PlaneCloud(surfaces.points(), options));
  ASSERT_EQ(found.planes.size(), 2u);
  EXPECT_LT(holderOf(front, found).seen_from.x(), -0.999);
  EXPECT_GT(holderOf(back, found).seen_from.x(), 0.999);
}

TEST(SegmentPlanes, AHoleIsNoPartOfTheOutline)
{
  test::Surfaces surfaces;
  const Vector3d u(0, 1, 0), v(0, 0, 1);
  surfaces.add({2, -1.5, -1.5}, 3 * u, 1 * v, 0.02);
  surfaces.add({2, -1.5, 0.5}, 3 * u, 1 * v, 0.02);
  surfaces.add({2, -1.5, -0.5}, 1 * u, 1 * v, 0.02);
  surfaces.add({2, 0.5, -0.5}, 1 * u, 1 * v, 0.02);
  const auto found = segmented(surfaces.points());
  ASSERT_EQ(found.planes.size(), 1u);
  EXPECT_NEAR(found.planes[0].plane.area, 8, 0.03 * 8);
  ASSERT_EQ(found.planes[0].outline.size(), 2u);
  for (const auto& corner : found.planes[0].outline[1]) {
    EXPECT_LT(std::abs(corner.y()), 0.55);
    EXPECT_LT(std::abs(corner.z()), 0.55);
  }
}
