// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"
#include "support/poses.h"

#include <pcl6d/benchmarking/plane_thickness.h>

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

using pcl6d::MapPoints;
using pcl6d::PlaneSegment;
using pcl6d::planeThickness;
using pcl6d::PlaneThicknessOptions;
using pcl6d::Random;
using pcl6d::test::badArgumentOf;

namespace {
/** A wall of 4 m x 2 m in the plane x = 3, seen from the origin. */
PlaneSegment
wall()
{
  PlaneSegment segment;
  segment.plane.normal = Eigen::Vector3d::UnitX();
  segment.plane.offset = 3;
  segment.plane.hull = {{3, -2, 0}, {3, 2, 0}, {3, 2, 2}, {3, -2, 2}};
  segment.plane.area = 8;
  segment.seen_from = -Eigen::Vector3d::UnitX();
  return segment;
}

/** Points of a scan on that wall, moved towards +x, with noise [m]. */
void
addScan(MapPoints& map,
        std::uint32_t scan,
        double shift,
        double sigma,
        std::size_t count = 4000,
        const Eigen::Vector3f& normal = -Eigen::Vector3f::UnitX())
{
  Random random(scan + 1);
  for (std::size_t i = 0; i < count; ++i) {
    map.points.push_back(Eigen::Vector3d(3 + shift + sigma * random.normal(),
                                         random.uniform(-2, 2),
                                         random.uniform(0, 2))
                             .cast<float>());
    map.normals.push_back(normal);
    map.scans.push_back(scan);
  }
}
} // namespace

TEST(PlaneThickness, IsTheNoiseOfScansThatAgree)
{
  MapPoints map;
  addScan(map, 0, 0, 0.01);
  addScan(map, 1, 0, 0.02);
  const auto result = planeThickness({wall()}, map, 3);
  ASSERT_EQ(result.planes.size(), 1u);
  EXPECT_EQ(result.planes[0].scans, 2u);
  EXPECT_NEAR(result.rms, std::sqrt((1e-4 + 4e-4) / 2), 3e-4);
  EXPECT_EQ(result.median, result.planes[0].thickness);
  EXPECT_NEAR(result.scans[0], 0.01, 3e-4);
  EXPECT_NEAR(result.scans[1], 0.02, 6e-4);
  EXPECT_TRUE(std::isnan(result.scans[2]));
}

TEST(PlaneThickness, IsHalfTheGapOfADoubledWall)
{
  MapPoints map;
  addScan(map, 0, 0, 0);
  addScan(map, 1, 0.1, 0);
  const auto result = planeThickness({wall()}, map, 2);
  EXPECT_NEAR(result.rms, 0.05, 1e-3);
  // The fit stands in the middle, though the plane came from the first scan.
  EXPECT_NEAR(result.planes[0].plane.offset, 3.05, 2e-3);
  EXPECT_NEAR(result.planes[0].plane.normal.x(), 1, 1e-5) << "offset >= 0";
  EXPECT_EQ(result.planes[0].plane.inliers, 8000u);
}

TEST(PlaneThickness, TakesOnlyPointsThatAreOfThePlane)
{
  MapPoints map;
  addScan(map, 0, 0, 0.01);
  addScan(map, 1, 0, 0.01);
  const double before = planeThickness({wall()}, map, 2).rms;
  addScan(map, 0, 0.5, 0.01);                                 // another wall
  addScan(map, 1, 0.1, 0.01, 1000, Eigen::Vector3f::UnitX()); // its other face
  addScan(map, 1, 0.1, 0.01, 1000, Eigen::Vector3f::UnitY()); // a shelf
  addScan(map, 1, 0.1, 0.01, 1000, Eigen::Vector3f::Zero());  // no surface
  map.points.emplace_back(3.1f, 2.5f, 1.0f);                  // beside the hull
  map.points.emplace_back(pcl6d::test::kNan, 0.0f, 1.0f);
  map.normals.insert(map.normals.end(), 2, -Eigen::Vector3f::UnitX());
  map.scans.insert(map.scans.end(), 2, 0);
  EXPECT_EQ(planeThickness({wall()}, map, 2).rms, before);
}

TEST(PlaneThickness, LeavesOutWhatLiesInAHoleOfTheOutline)
{
  MapPoints map;
  addScan(map, 0, 0, 0);
  addScan(map, 1, 0, 0);
  PlaneSegment window = wall(); // an L with a hole
  window.outline = {
      {{3, -2, 0}, {3, 2, 0}, {3, 2, 1}, {3, 0, 1}, {3, 0, 2}, {3, -2, 2}},
      {{3, -1.5, 0.5}, {3, -1.5, 1.5}, {3, -0.5, 1.5}, {3, -0.5, 0.5}}};
  for (const auto& [y, z, inside] : {std::tuple(1.0, 0.5, true),
                                     {1.0, 1.5, false},
                                     {-1.0, 1.0, false},
                                     {-1.75, 1.0, true}}) {
    MapPoints one = map;
    for (int i = 0; i < 1000; ++i) {
      one.points.push_back(Eigen::Vector3d(3.1, y, z).cast<float>());
      one.normals.push_back(-Eigen::Vector3f::UnitX());
      one.scans.push_back(0);
    }
    const double rms = planeThickness({window}, one, 2).rms;
    EXPECT_EQ(rms > 0.02, inside) << y << ' ' << z << ": " << rms;
  }
}

TEST(PlaneThickness, CountsASurfaceOnce)
{
  MapPoints map;
  addScan(map, 0, 0, 0.01);
  addScan(map, 1, 0, 0.01);
  PlaneSegment part = wall(); // the same wall, as a nearer scan saw it
  part.plane.hull = {{3, -1, 0}, {3, -1, 1}, {3, 1, 1}, {3, 1, 0}};
  part.plane.area = 2;
  PlaneSegment back = part; // its other face
  back.seen_from = -back.seen_from;
  EXPECT_EQ(planeThickness({part, wall()}, map, 2).planes.size(), 1u);
  EXPECT_EQ(planeThickness({part, wall()}, map, 2).planes[0].plane.area, 8);
  EXPECT_EQ(planeThickness({part, back}, map, 2).planes.size(), 1u) << "no points";
}

TEST(PlaneThickness, NeedsTwoScansAndEnoughPoints)
{
  MapPoints map;
  addScan(map, 0, 0, 0.01);
  const auto alone = planeThickness({wall()}, map, 2);
  EXPECT_TRUE(alone.planes.empty());
  EXPECT_TRUE(std::isnan(alone.rms));
  EXPECT_TRUE(std::isnan(alone.median));
  MapPoints few;
  addScan(few, 0, 0, 0.01, 20);
  addScan(few, 1, 0, 0.01, 20);
  EXPECT_TRUE(planeThickness({wall()}, few, 2).planes.empty());
  PlaneThicknessOptions options;
  options.min_points = 10;
  EXPECT_EQ(planeThickness({wall()}, few, 2, options).planes.size(), 1u);
  options.min_area = 9;
  EXPECT_TRUE(planeThickness({wall()}, few, 2, options).planes.empty());
  EXPECT_TRUE(planeThickness({}, few, 2).planes.empty());
  EXPECT_EQ(planeThickness({}, {}, 2).scans.size(), 2u);
}

TEST(PlaneThickness, RefusesWhatDoesNotFitTogether)
{
  MapPoints map;
  addScan(map, 0, 0, 0, 10);
  addScan(map, 1, 0, 0, 10);
  EXPECT_NE(badArgumentOf([&] { planeThickness({}, map, 1); }), "");
  map.normals.pop_back();
  EXPECT_NE(badArgumentOf([&] { planeThickness({}, map, 2); }), "");
  const auto refused = [&](auto change) {
    PlaneThicknessOptions options;
    change(options);
    return badArgumentOf([&] { planeThickness({}, {}, 1, options); });
  };
  EXPECT_EQ(refused([](auto& o) { o.gate = 0; }).find("gate = 0"), 0u);
  EXPECT_EQ(refused([](auto& o) { o.max_angle = 2; }).find("max_angle = 2"), 0u);
  EXPECT_EQ(refused([](auto& o) { o.min_area = -1; }).find("min_area = -1"), 0u);
  EXPECT_EQ(refused([](auto& o) { o.min_points = 3; }).find("min_points = 3"), 0u);
  EXPECT_EQ(refused([](auto& o) { o.max_planes = 0; }).find("max_planes = 0"), 0u);
}
