// SPDX-License-Identifier: BSD-3-Clause
// Distances between the surfaces of two runs, with their levels of detection.
#include "compared_rooms.h"
#include "support/points.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/median.h>

#include <gtest/gtest.h>

namespace {
using namespace pcl6d;
using namespace pcl6d::test;

constexpr double kShift = 0.05;     // [m] of the wall
constexpr double kShiftTol = 0.005; // [m] the noise of one point; means are better

SurfaceDistanceOptions
surfaceOptions()
{
  SurfaceDistanceOptions o;
  o.voxel = kVoxel;
  return o;
}

PillarRoom
roomWithMovedWall()
{
  PillarRoom room;
  room.walls.max().y() -= kShift; // nearer
  return room;
}

bool
isOnMovedWall(const SurfaceDistance& one)
{
  return one.place.y() > 3.9F && one.normal.y() < -0.9F;
}
} // namespace

TEST(SurfaceDistance, OfAWallThatMovedIsItsWay)
{
  const RoomRun a({}, driveThrough(0), 3), b(roomWithMovedWall(), driveThrough(0.7), 4);
  std::vector<double> wall;
  std::size_t others = 0, false_alarms = 0, found = 0;
  for (const SurfaceDistance& one : surfaceDistances(a.run, b.run, surfaceOptions())) {
    if (isOnMovedWall(one)) {
      wall.push_back(one.distance);
      found += one.isSignificant() ? 1 : 0;
      continue;
    }
    if (one.place.y() > 3.8F)
      continue; // edges of the wall
    ++others;
    false_alarms += one.isSignificant() ? 1 : 0;
  }
  ASSERT_GT(wall.size(), 100u);
  EXPECT_GT(found, wall.size() * 9 / 10); // the rest is next to corners and pillars
  EXPECT_NEAR(upperMedian(wall), kShift, kShiftTol);
  ASSERT_GT(others, 1000u);
  EXPECT_LT(false_alarms, others / 20); // 95 %
}

TEST(SurfaceDistance, IsToldOfAsASurface)
{
  const RoomRun a({}, driveThrough(0), 3), b(roomWithMovedWall(), driveThrough(0.7), 4);
  const RunChanges found = findChanges(a.run, b.run, changesOptions());
  ASSERT_EQ(found.changes.size(), 1u) << describe(found);
  const Change& wall = found.changes[0];
  EXPECT_EQ(wall.kind, ChangeKind::kSurface);
  EXPECT_NEAR(wall.distance, kShift, kShiftTol);
  EXPECT_LT(wall.lod, kShift / 2);
  EXPECT_GT(wall.confidence, 0.99);
  EXPECT_NEAR(wall.box.T_world_box.translation().y(), 4, kVoxel);
}

TEST(SurfaceDistance, IsWithinItsLevelOfDetectionWhereNothingMoved)
{
  const RoomRun a({}, driveThrough(0), 3), b({}, driveThrough(0.7), 4);
  const auto distances = surfaceDistances(a.run, b.run, surfaceOptions());
  std::size_t significant = 0;
  for (const SurfaceDistance& one : distances) {
    EXPECT_GT(one.lod, 0);
    EXPECT_GE(one.points, surfaceOptions().least_points);
    EXPECT_NEAR(one.normal.norm(), 1, 1e-5);
    significant += one.isSignificant() ? 1 : 0;
  }
  ASSERT_GT(distances.size(), 1000u);
  EXPECT_LT(significant, distances.size() / 20); // 95 %
}

TEST(SurfaceDistance, IsLessSureWherePosesAre)
{
  const RoomRun a({}, driveThrough(0), 3);
  RoomRun b(roomWithMovedWall(), driveThrough(0.7), 4);
  constexpr double kSigma = 0.08; // [m] of all poses of B
  const auto sure = surfaceDistances(a.run, b.run, surfaceOptions());
  for (ComparedScan& scan : b.run)
    scan.covariance.topLeftCorner<3, 3>() =
        kSigma * kSigma * Eigen::Matrix3d::Identity();
  const auto unsure = surfaceDistances(a.run, b.run, surfaceOptions());
  ASSERT_EQ(sure.size(), unsure.size());
  for (std::size_t i = 0; i < sure.size(); ++i) {
    EXPECT_EQ(sure[i].distance, unsure[i].distance);
    // A has none of it: half of the variance is that of B.
    EXPECT_GE(unsure[i].lod, 1.96 * kSigma / std::sqrt(2));
    if (isOnMovedWall(unsure[i])) {
      EXPECT_FALSE(unsure[i].isSignificant());
    }
  }
}

TEST(SurfaceDistance, IsNotFoundBeyondTheDepth)
{
  PillarRoom far;
  far.walls.max().y() -= 0.6; // six voxels
  const RoomRun a({}, driveThrough(0), 3), b(far, driveThrough(0.7), 4);
  for (const SurfaceDistance& one : surfaceDistances(a.run, b.run, surfaceOptions()))
    EXPECT_FALSE(isOnMovedWall(one)) << one.place.transpose();
}

TEST(SurfaceDistance, RefusesWrongOptions)
{
  const auto refused = [](const auto& change) {
    SurfaceDistanceOptions o = surfaceOptions();
    change(o);
    return badArgumentOf([&] { surfaceDistances({}, {}, o); });
  };
  const std::string rule = ", but must be finite and > 0";
  EXPECT_EQ(refused([](auto& o) { o.voxel = 0; }), "voxel = 0" + rule);
  EXPECT_EQ(refused([](auto& o) { o.spacing = -1; }), "spacing = -1" + rule);
  EXPECT_EQ(refused([](auto& o) { o.normal = 0; }), "normal = 0" + rule);
  EXPECT_EQ(refused([](auto& o) { o.cylinder = 0; }), "cylinder = 0" + rule);
  EXPECT_EQ(refused([](auto& o) { o.depth = -2; }), "depth = -2" + rule);
  EXPECT_EQ(refused([](auto& o) { o.least_points = 0; }),
            "least_points = 0, but must be > 0");
}
