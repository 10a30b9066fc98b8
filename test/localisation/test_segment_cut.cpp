// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"

#include <pcl6d/common/random.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/localisation/segment_cut.h>

#include <gtest/gtest.h>

#include <algorithm>

using namespace pcl6d;

namespace {
Plane
upright(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double height)
{
  Plane plane;
  const Eigen::Vector2d along = (b - a).normalized();
  plane.normal << along.y(), -along.x(), 0;
  plane.offset = plane.normal.head<2>().dot(a);
  plane.hull = {{a.x(), a.y(), 0},
                {b.x(), b.y(), 0},
                {b.x(), b.y(), height},
                {a.x(), a.y(), height}};
  plane.area = height * (b - a).norm();
  plane.label = "wall";
  plane.inliers = 100;
  return plane;
}

Plane
turned(Plane plane, const Eigen::Matrix3d& R)
{
  plane.normal = R * plane.normal;
  for (auto& corner : plane.hull)
    corner = R * corner;
  return plane;
}

void
expectSegment(const Segment& s,
              const Eigen::Vector2d& a,
              const Eigen::Vector2d& b,
              double tolerance)
{
  const bool same =
      (s.a - a).norm() + (s.b - b).norm() < (s.a - b).norm() + (s.b - a).norm();
  EXPECT_LT((s.a - (same ? a : b)).norm(), tolerance) << s.a.transpose();
  EXPECT_LT((s.b - (same ? b : a)).norm(), tolerance) << s.b.transpose();
}
} // namespace

TEST(WallsOf, AreThePlansOfTheWallsThatWereSeen)
{
  std::vector<Plane> planes(5, upright({1, 2}, {5, 2}, 3));
  planes[1] = upright({5, 2}, {5, 9}, 3);
  planes[1].label = "door";
  planes[2].label = "floor";
  planes[3].inliers = 0;
  planes[4] = upright({7, 7}, {7, 7.2}, 3); // too short
  const Segments walls = wallsOf(planes);
  ASSERT_EQ(walls.size(), 2u);
  expectSegment(walls[0], {1, 2}, {5, 2}, 1e-9);
  expectSegment(walls[1], {5, 2}, {5, 9}, 1e-9);
  EXPECT_TRUE(wallsOf({}).empty());
}

TEST(WallsOf, AreLevelledFirst)
{
  const Eigen::Matrix3d R = rotationFromEuler({0.05, -0.08, 0});
  const std::vector<Plane> planes{turned(upright({0, 0}, {9, 0}, 4), R.transpose()),
                                  turned(upright({9, 0}, {9, 6}, 4), R.transpose())};
  const Eigen::Matrix3d level = levelOfPlanes(planes);
  EXPECT_LT(rotationAngle(level * R.transpose()), 1e-6);
  const Segments walls = wallsOf(planes, level);
  ASSERT_EQ(walls.size(), 2u);
  expectSegment(walls[0], {0, 0}, {9, 0}, 1e-5);
  expectSegment(walls[1], {9, 0}, {9, 6}, 1e-5);
}

TEST(SliceOf, AMeshIsExact)
{
  TriangleMesh wall; // from (1, 0) to (4, 0), 3 m high, and a floor
  wall.vertices = {{1, 0, 0}, {4, 0, 0}, {4, 0, 3}, {1, 0, 3}, {0, 5, 1.5}};
  wall.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Segments cut = sliceOf(wall, 1.5);
  ASSERT_EQ(cut.size(), 2u);
  expectSegment(cut[0], {2.5, 0}, {4, 0}, 1e-12);
  expectSegment(cut[1], {1, 0}, {2.5, 0}, 1e-12);
  EXPECT_TRUE(sliceOf(wall, 3.5).empty());
  wall.vertices = {{0, 0, 1.5}, {1, 0, 1.5}, {0, 1, 1.5}};
  wall.triangles = {{0, 1, 2}};
  EXPECT_TRUE(sliceOf(wall, 1.5).empty()) << "a floor at that height is no wall";
}

TEST(SliceOf, ACloudFindsItsWalls)
{
  Random random(4);
  Points points;
  const auto addWall = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    for (double s = 0; s <= 1; s += 0.03 / (b - a).norm())
      for (double z = 0; z < 3; z += 0.05) {
        const Eigen::Vector2d p = a + s * (b - a);
        points.push_back(Eigen::Vector3d(p.x() + 0.01 * random.normal(),
                                         p.y() + 0.01 * random.normal(),
                                         z)
                             .cast<float>());
      }
  };
  addWall({0, 0}, {6, 0});
  addWall({6, 0}, {6, 4});
  addWall({1, 5}, {4, 7});               // neither along x nor along y
  for (double x = -5; x < 10; x += 0.05) // ground, and a table
    for (double y = -5; y < 10; y += 0.05) {
      points.push_back(Eigen::Vector3d(x, y, 0).cast<float>());
      if (x > 2 && x < 3 && y > 1 && y < 2)
        points.push_back(Eigen::Vector3d(x, y, 0.8).cast<float>());
    }
  points.push_back({pcl6d::test::kNan, 0, 1});
  Segments walls = sliceOf(points, CloudSliceOptions());
  ASSERT_EQ(walls.size(), 3u);
  std::sort(walls.begin(), walls.end(), [](const Segment& s, const Segment& t) {
    return (s.a - s.b).norm() > (t.a - t.b).norm();
  });
  expectSegment(walls[0], {0, 0}, {6, 0}, 0.25);
  expectSegment(walls[1], {6, 0}, {6, 4}, 0.25);
  expectSegment(walls[2], {1, 5}, {4, 7}, 0.25);
  EXPECT_NEAR(walls[0].a.y(), 0, 0.05);
  EXPECT_NEAR(walls[1].a.x(), 6, 0.05);
  EXPECT_TRUE(sliceOf(Points(), CloudSliceOptions()).empty());
}

TEST(SliceOf, RefusesOptionsThatBreakTheirRules)
{
  for (const auto& spoil :
       std::vector<void (*)(CloudSliceOptions&)>{[](auto& o) { o.high = o.low; },
                                                 [](auto& o) { o.low = std::nan(""); },
                                                 [](auto& o) { o.cell = 0; },
                                                 [](auto& o) { o.min_cover = 2; },
                                                 [](auto& o) { o.max_distance = 0; },
                                                 [](auto& o) { o.max_gap = 0; },
                                                 [](auto& o) { o.min_length = 0; }}) {
    CloudSliceOptions options;
    spoil(options);
    EXPECT_THROW(sliceOf(Points(), options), BadArgument);
  }
}
