// SPDX-License-Identifier: BSD-3-Clause
#include "support/box_room.h"
#include "support/constants.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/scene_interpretation/relations.h>

#include <gtest/gtest.h>

#include <cmath>

namespace {
using pcl6d::Relation;
using pcl6d::ScenePlane;
using pcl6d::test::kDegree;
using pcl6d::test::kUp;
using pcl6d::test::kX;
using pcl6d::test::kY;
using pcl6d::test::rectangle;
using pcl6d::test::TruePlane;

ScenePlane
scene(const TruePlane& plane)
{
  return levelledPlane(plane.plane, Eigen::Matrix3d::Identity(), plane.seen_from);
}

ScenePlane
level(const Eigen::Vector3d& centre)
{
  return scene(rectangle("", centre, kX, kY));
}

// An upright rectangle, 2 m wide and 2 m high, turned about the vertical.
ScenePlane
upright(const Eigen::Vector3d& centre, double yaw = 0)
{
  const Eigen::Vector3d along(std::cos(yaw), std::sin(yaw), 0);
  return scene(rectangle("", centre, along, kUp));
}

bool
is(Relation relation, const ScenePlane& i, const ScenePlane& j)
{
  return holds(relation, i, j, {});
}
} // namespace

TEST(Relations, OfAnglesTakeTenDegrees)
{
  for (const double sign : {-1.0, 1.0}) {
    const auto a = upright({0, 0, 1});
    EXPECT_TRUE(is(Relation::kParallel, a, upright({0, 3, 1}, sign * 9.9 * kDegree)));
    EXPECT_FALSE(is(Relation::kParallel, a, upright({0, 3, 1}, sign * 10.1 * kDegree)));
    EXPECT_TRUE(is(Relation::kParallel, a, upright({0, 3, 1}, M_PI + sign * 0.1)));
    EXPECT_TRUE(is(
        Relation::kOrthogonal, a, upright({0, 3, 1}, M_PI_2 + sign * 9.9 * kDegree)));
    EXPECT_FALSE(is(
        Relation::kOrthogonal, a, upright({0, 3, 1}, M_PI_2 + sign * 10.1 * kDegree)));
  }
  EXPECT_TRUE(is(Relation::kOrthogonal, upright({0, 0, 1}, 0.3), level({0, 0, 0})));
}

TEST(Relations, OfHeightsTakeTwentyCentimetres)
{
  const auto low = level({0, 0, 1});
  EXPECT_TRUE(is(Relation::kAbove, level({0, 0, 1.21}), low));
  EXPECT_FALSE(is(Relation::kAbove, level({0, 0, 1.19}), low));
  EXPECT_TRUE(is(Relation::kUnder, low, level({0, 0, 1.21})));
  EXPECT_FALSE(is(Relation::kUnder, level({0, 0, 1.21}), low));
  EXPECT_TRUE(is(Relation::kEqualHeight, low, level({0, 0, 1.19})));
  EXPECT_FALSE(is(Relation::kEqualHeight, low, level({0, 0, 0.79})));
}

TEST(Relations, ADoorIsRecessedInTheWallOnItsSideOnly)
{
  const auto wall =
      scene(rectangle("", {0, 0, 1.3}, 3 * kX, 1.3 * kUp)); // seen from -y
  const auto door = [&](double y, double x = 1) {
    return scene(rectangle("", {x, y, 1}, 0.45 * kX, kUp));
  };
  EXPECT_TRUE(is(Relation::kRecessed, door(0.05), wall));
  EXPECT_TRUE(is(Relation::kRecessed, door(-0.01), wall));
  EXPECT_FALSE(is(Relation::kRecessed, door(-0.03), wall)); // the back of a shelf
  EXPECT_TRUE(is(Relation::kOnto, door(-0.03), wall));
  EXPECT_FALSE(is(Relation::kRecessed, door(0.25), wall));
  EXPECT_FALSE(is(Relation::kRecessed, door(0.05, 4), wall));
  auto behind = door(0.05);
  behind.normal = -behind.normal;
  EXPECT_FALSE(is(Relation::kRecessed, behind, wall));
}

TEST(Relations, ALeafHangsAtAWallByOneOfItsEdges)
{
  const auto wall = scene(rectangle("", {0, 0, 1.3}, 3 * kX, 1.3 * kUp));
  const auto leaf = [&](double x, double y, double yaw) {
    const Eigen::Vector3d along(std::cos(yaw), std::sin(yaw), 0);
    return scene(
        rectangle("", Eigen::Vector3d(x, y, 1) + 0.45 * along, 0.45 * along, kUp));
  };
  EXPECT_TRUE(is(Relation::kHinged, leaf(1, 0.1, M_PI_2), wall));
  EXPECT_TRUE(is(Relation::kHinged, leaf(1, -0.1, 0.6), wall));
  EXPECT_TRUE(is(Relation::kHinged, leaf(1, -1.0, M_PI_2), wall)); // by the other edge
  EXPECT_FALSE(is(Relation::kHinged, leaf(1, 0.1, 0.4), wall));    // 23 deg: no leaf
  EXPECT_FALSE(is(Relation::kHinged, leaf(1, 0.4, M_PI_2), wall));
  EXPECT_FALSE(is(Relation::kHinged, leaf(3.5, 0.1, M_PI_2), wall));
}

TEST(Relations, StepsAreNearAndAsHighAsSteps)
{
  const auto step = level({0, 0, 1});
  EXPECT_TRUE(is(Relation::kStep, level({2.05, 0, 1.17}), step));
  EXPECT_TRUE(is(Relation::kStep, level({2.05, 0, 0.83}), step));
  EXPECT_FALSE(is(Relation::kStep, level({2.05, 0, 1.3}), step));
  EXPECT_FALSE(is(Relation::kStep, level({2.05, 0, 1.05}), step));
  EXPECT_FALSE(is(Relation::kStep, level({2.2, 0, 1.17}), step));
}

TEST(Relations, OfHullsSeeThemInSpaceAndInPlan)
{
  const auto floor = level({0, 0, 0});
  EXPECT_TRUE(is(Relation::kApart, level({2.1, 0, 0}), floor));
  EXPECT_FALSE(is(Relation::kApart, level({1.9, 0, 5}), floor));
  EXPECT_FALSE(is(Relation::kApart, upright({0, 0.9, 3}), floor));
  EXPECT_TRUE(is(Relation::kApart, upright({0, 1.1, 0}), floor));
  EXPECT_TRUE(is(Relation::kTouches, level({2.05, 0, 0}), floor));
  EXPECT_FALSE(is(Relation::kTouches, level({2.15, 0, 0}), floor));
  EXPECT_TRUE(is(Relation::kTouches, upright({0, 0.2, 0.5}), floor)); // cuts through
  EXPECT_TRUE(is(Relation::kTouches, upright({0, 0, 1.05}), floor));
  EXPECT_NEAR(hullDistance(upright({0, 0, 1.3}), floor), 0.3, 1e-12);
  EXPECT_NEAR(hullDistance(level({3, 0, 1}), floor), std::sqrt(2.0), 1e-12);
}

TEST(Relations, AreTheSameHoweverTheSceneIsTurnedAndMoved)
{
  pcl6d::Random random(3);
  const auto room = pcl6d::test::BoxRoom().planes();
  const auto turned =
      pcl6d::test::turned(room, pcl6d::rotationFromVector(random.uniform(1, 6) * kUp));
  for (int r = 0; r <= static_cast<int>(Relation::kApart); ++r)
    for (std::size_t i = 0; i < room.size(); ++i)
      for (std::size_t j = 0; j < room.size(); ++j) {
        const auto relation = static_cast<Relation>(r);
        EXPECT_EQ(is(relation, scene(room[i]), scene(room[j])),
                  is(relation, scene(turned[i]), scene(turned[j])))
            << toString(relation) << ' ' << i << ' ' << j;
      }
}

TEST(Relations, HaveNamesThatLeadBack)
{
  for (int r = 0; r <= static_cast<int>(Relation::kApart); ++r) {
    const auto relation = static_cast<Relation>(r);
    EXPECT_EQ(pcl6d::relationFromName(toString(relation)), relation);
  }
  EXPECT_FALSE(pcl6d::relationFromName("beneath"));
}

TEST(ScenePlane, KnowsItsSizes)
{
  const auto door =
      scene(rectangle("", {1, 2, 1.5}, Eigen::Vector3d(0.3, 0.4, 0), 1.1 * kUp));
  EXPECT_NEAR(door.width, 1, 1e-12);
  EXPECT_NEAR(door.length, 2.2, 1e-12);
  EXPECT_NEAR(door.bottom, 0.4, 1e-12);
  EXPECT_NEAR(measured(pcl6d::Measure::kHeight, door).value(), 2.2, 1e-12);
  EXPECT_NEAR(door.inclination, M_PI_2, 1e-7);
  const auto table = scene(rectangle(
      "", {1, 2, 0.7}, Eigen::Vector3d(0.6, 0.8, 0), Eigen::Vector3d(-0.4, 0.3, 0)));
  EXPECT_NEAR(table.width, 1, 1e-12);
  EXPECT_NEAR(table.length, 2, 1e-12);
  EXPECT_NEAR(table.inclination, 0, 1e-7);
  EXPECT_FALSE(measured(pcl6d::Measure::kBottom, table));
}

TEST(RelationTolerances, AreChecked)
{
  pcl6d::RelationTolerances tolerances;
  EXPECT_NO_THROW(tolerances.validate());
  tolerances.max_step = tolerances.min_step;
  EXPECT_THROW(tolerances.validate(), pcl6d::BadArgument);
}
