// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/simulation/ground_survey.h>
#include <pcl6d/simulation/scene_builder.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using pcl6d::BadArgument;
using pcl6d::ComputeFailed;
using pcl6d::GroundMap;
using pcl6d::GroundSurvey;
using pcl6d::Points;

constexpr double kHeight = 0.9; // [m] of the scanner

// A floor of 20 m x 20 m with a table, a pane that is 1 cm thick, a platform of 0.4 m, a
// wall with a door of 1.2 m at x = 5, and a ramp of 10 % beyond it.
pcl6d::TriangleScene
furnishedHall()
{
  pcl6d::TriangleScene scene;
  pcl6d::addBox(scene, {-10, -10, -0.2}, {10, 10, 0}, {"floor", 0.4});
  pcl6d::addBox(scene, {-3, 2, 0.7}, {-1, 3, 0.75}, {"table", 0.4});
  pcl6d::addBox(scene, {-8, -4.01, 0}, {-2, -4, 2}, {"pane", 0.1});
  pcl6d::addBox(scene, {0, -8, 0}, {3, -5, 0.4}, {"platform", 0.4});
  pcl6d::Wall wall{{5, -10}, {5, 10}, 0.2, -0.2, 2.5, {}};
  wall.openings = {{9.4, 10.6, -0.1, 2.2}}; // y in [-0.6, 0.6]
  pcl6d::addWall(scene, wall, {"wall", 0.7});
  pcl6d::addRamp(scene, {{6, 4}, {9, 4}, 4, -0.2, 0, 0.3}, {"ramp", 0.4});
  return scene;
}

GroundMap
mapOfHall()
{
  const pcl6d::RayCaster caster(furnishedHall());
  return pcl6d::groundOfScene(caster, {{-1, 0, kHeight}, {0, 0, kHeight}}, kHeight, 12);
}
} // namespace

TEST(GroundOfScene, IsFreeWhereNothingStandsAndOneCanWalk)
{
  const GroundMap map = mapOfHall();
  for (const Eigen::Vector2d& free : {Eigen::Vector2d(0, 0),
                                      Eigen::Vector2d(-8, 8),
                                      Eigen::Vector2d(-5, -8), // round the pane
                                      Eigen::Vector2d(8, 0)})  // through the door
    EXPECT_GT(map.room(free), 0.4) << free.transpose();
  EXPECT_EQ(map.room({-2, 2.5}), 0) << "under the table";
  EXPECT_EQ(map.room({5, 5}), 0) << "in the wall";
  EXPECT_EQ(map.room({1.5, -6}), 0) << "up a step";
  EXPECT_TRUE(map.isFree({0, 0}, {8, 0}, 0.3)) << "through the door";
  EXPECT_FALSE(map.isFree({0, 1}, {8, 1}, 0.05)) << "through the wall";
  EXPECT_FALSE(map.isFree({-5, -2}, {-5, -6}, 0)) << "through the pane";
  EXPECT_FALSE(map.isFree({-2, 0}, {-2, 5}, 0)) << "under the table";
}

TEST(GroundOfScene, KeepsItsDistanceFromWhatIsThere)
{
  const GroundMap map = mapOfHall();
  for (double y = -9; y < 9; y += 0.173) {
    EXPECT_LE(map.room({4, y}), std::abs(y) < 0.6 ? 1.1 : 0.9 + 1e-9) << "y = " << y;
    EXPECT_LE(map.room({-5, y}), std::abs(y + 4.005) + 1e-9) << "y = " << y;
  }
}

TEST(GroundOfScene, FollowsARamp)
{
  const GroundMap map = mapOfHall();
  for (const double x : {6.5, 7.25, 8.5}) {
    ASSERT_TRUE(map.floor({x, 4}));
    EXPECT_NEAR(*map.floor({x, 4}), 0.1 * (x - 6), 1e-9);
  }
}

TEST(GroundOfScene, RefusesWhatHasNoGround)
{
  const pcl6d::RayCaster caster(furnishedHall());
  const std::vector<Eigen::Vector3d> places = {{0, 0, kHeight}};
  EXPECT_THROW(pcl6d::groundOfScene(caster, {}, kHeight, 5), BadArgument);
  for (const double reach : {0.0, -1.0, 1001.0, std::nan("")})
    EXPECT_THROW(pcl6d::groundOfScene(caster, places, kHeight, reach), BadArgument);
  EXPECT_THROW(pcl6d::groundOfScene(caster, {{0, 0, 9}}, kHeight, 5), ComputeFailed);
  EXPECT_THROW(pcl6d::groundOfScene(caster, {{50, 0, kHeight}}, kHeight, 5),
               ComputeFailed);
  EXPECT_THROW(
      pcl6d::groundOfScene(caster, {{0, 0, kHeight}, {1e5, 1e5, kHeight}}, kHeight, 5),
      ComputeFailed)
      << "too large an area";
}

namespace {
// A floor at z = 0.3 with a hole of 0.7 m in the measurements, a box on it, and noise-free
// points of a wall at y = 5, seen from (0, 0, 1.5).
Points
scanOfYard()
{
  Points points;
  for (double x = -7; x < 7; x += 0.08)
    for (double y = -7; y < 5; y += 0.08) {
      const bool is_hole = std::abs(x - 3) < 0.35 && std::abs(y) < 0.35;
      const bool is_box = std::abs(x + 3) < 0.5 && std::abs(y) < 0.5;
      if (!is_hole)
        points.emplace_back(x, y, is_box ? 1.1f : 0.3f);
    }
  for (double x = -7; x < 7; x += 0.08)
    for (double z = 0.3; z < 3; z += 0.08)
      points.emplace_back(x, 5, z);
  return points;
}
} // namespace

TEST(GroundSurvey, FindsTheFloorAndWhatStandsOnIt)
{
  GroundSurvey survey({{0, 0, 1.5}}, 6);
  survey.add(0, scanOfYard());
  const GroundMap map = survey.map();
  ASSERT_TRUE(map.floor({1, 1}));
  EXPECT_NEAR(*map.floor({1, 1}), 0.3, 0.05); // layers of 0.05 m
  EXPECT_GT(map.room({1, 1}), 0.5);
  EXPECT_EQ(map.room({-3, 0}), 0) << "on the box";
  EXPECT_GT(map.room({3, 0}), 0.3) << "a gap of the measurements is closed";
  EXPECT_EQ(map.room({0, 5.05}), 0) << "in the wall";
  EXPECT_EQ(map.room({0, 5.6}), 0) << "behind the wall";
  EXPECT_FALSE(map.isFree({-5, 0}, {0, 0}, 0));
  EXPECT_FALSE(map.floor({6.5, 0})) << "out of reach";
}

TEST(GroundSurvey, RefusesScansWithoutGround)
{
  EXPECT_THROW(GroundSurvey({}, 5), BadArgument);
  EXPECT_THROW(GroundSurvey({{0, 0, 1}}, 0), BadArgument);
  EXPECT_THROW(GroundSurvey({{0, std::nan(""), 1}}, 5), BadArgument);
  EXPECT_THROW(GroundSurvey({{0, 0, 1}, {1e6, 1e6, 1}}, 5), ComputeFailed);
  GroundSurvey survey({{0, 0, 1.5}}, 6);
  EXPECT_THROW(survey.add(1, {}), BadArgument);
  EXPECT_THROW(survey.map(), ComputeFailed) << "nothing was seen";
  Points wall; // but no floor
  for (double x = -5; x < 5; x += 0.05)
    for (double z = 0; z < 3; z += 0.3)
      wall.emplace_back(x, 4, z + 0.05 * x);
  for (auto& p : wall)
    p.z() += 3; // all above the scanner
  survey.add(0, wall);
  EXPECT_THROW(survey.map(), ComputeFailed);
}
