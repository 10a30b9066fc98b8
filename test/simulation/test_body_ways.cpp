// SPDX-License-Identifier: BSD-3-Clause
#include "body_checks.h"

#include <pcl6d/common/error.h>
#include <pcl6d/simulation/body_ways.h>
#include <pcl6d/simulation/ground_survey.h>
#include <pcl6d/simulation/scene_builder.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {
using pcl6d::BadArgument;
using pcl6d::BodyKind;
using pcl6d::BodyWays;
using pcl6d::ComputeFailed;
using pcl6d::GroundMap;
using pcl6d::MovingBody;
using pcl6d::Random;
using pcl6d::ScannerTrack;

// 40 m x 24 m with a wall of 10 m, two pillars, and things beside the scanner's way, which
// is along x.
pcl6d::TriangleScene
yard()
{
  pcl6d::TriangleScene scene;
  pcl6d::addBox(scene, {-20, -12, -0.2}, {20, 12, 0}, {"floor", 0.4});
  pcl6d::addBox(scene, {-5, 3, 0}, {5, 3.2, 2.5}, {"wall", 0.6});
  pcl6d::addBox(scene, {-9, -4, 0}, {-8.7, -3.7, 3}, {"pillar", 0.6});
  pcl6d::addBox(scene, {7, -3, 0}, {7.3, -2.7, 3}, {"pillar", 0.6});
  pcl6d::addBox(scene, {0, -6, 0.6}, {2, -5, 0.7}, {"table", 0.6});
  return scene;
}

ScannerTrack
along()
{
  ScannerTrack track;
  for (int i = 0; i <= 60; ++i) { // 0.25 m/s
    track.times.push_back(i);
    track.places.emplace_back(-7.5 + 0.25 * i, 0, 0.9);
  }
  return track;
}

class YardWays : public testing::Test {
protected:
  const pcl6d::RayCaster caster_{yard()};
  const ScannerTrack track_ = along();
  const GroundMap map_ = pcl6d::groundOfScene(caster_, track_.places, 0.9, 15);

  BodyWays
  ways() const
  {
    return BodyWays(
        map_, track_, [this](double time, double near, double far, Random& random) {
          const double x = random.uniform(-1, 1);
          const double y = random.uniform(-1, 1);
          return Eigen::Vector2d(track_.placeAt(time).head<2>() +
                                 Eigen::Vector2d(x, y).normalized() *
                                     random.uniform(near, far));
        });
  }

  static std::vector<MovingBody>
  crowd(BodyWays ways)
  {
    return {ways.add(BodyKind::kCar, 5),
            ways.add(BodyKind::kPerson, 1),
            ways.add(BodyKind::kPerson, 2),
            ways.add(BodyKind::kPerson, 3)};
  }
};

double
planDistance(const Eigen::Isometry3d& a, const Eigen::Vector3d& b)
{
  return (a.translation() - b).head<2>().norm();
}
} // namespace

TEST_F(YardWays, BodiesNeverCutTheSceneAndStandOnTheFloor)
{
  for (const MovingBody& body : crowd(ways()))
    for (double time = 0; time <= 60; time += 0.37) {
      const Eigen::Isometry3d pose = body.poseAt(time);
      EXPECT_NEAR(pose.translation().z(), 0, 1e-9);
      EXPECT_EQ(pcl6d::test::cutBy(body.shape, pose, caster_, 0.05), "")
          << body.name << " at " << time << " s, " << pose.translation().transpose();
    }
}

TEST_F(YardWays, BodiesKeepAwayFromTheScannerAndFromEachOther)
{
  const auto bodies = crowd(ways());
  for (double time = 0; time <= 60; time += 0.1)
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const Eigen::Isometry3d pose = bodies[i].poseAt(time);
      const double keep = i == 0 ? 3.5 : 1.2;
      // It was looked at every 0.1 s, in which it goes 0.8 m at most.
      EXPECT_GT(planDistance(pose, track_.placeAt(time)), keep - (i == 0 ? 0.4 : 0.1));
      for (std::size_t k = 0; k < i; ++k)
        EXPECT_GT(planDistance(pose, bodies[k].poseAt(time).translation()), 0.5)
            << bodies[i].name << ' ' << bodies[k].name << " at " << time;
    }
}

TEST_F(YardWays, BodiesMoveMostOfTheTimeAtTheSpeedOfTheirKind)
{
  for (const MovingBody& body : crowd(ways())) {
    const auto rules =
        pcl6d::wayRules(body.name == "car" ? BodyKind::kCar : BodyKind::kPerson);
    ASSERT_EQ(body.times.size(), body.way.size());
    EXPECT_EQ(body.times.front(), 0);
    EXPECT_GE(body.times.back(), 60);
    double moving = 0;
    for (std::size_t i = 1; i < body.way.size(); ++i) {
      const double time = body.times[i] - body.times[i - 1];
      const double length = (body.way[i] - body.way[i - 1]).norm();
      if (time == 0 || length == 0)
        continue; // a jump, or it waits
      moving += time;
      EXPECT_GE(length / time, rules.slowest - 1e-6);
      EXPECT_LE(length / time, rules.fastest + 1e-6);
    }
    EXPECT_GT(moving, 30) << body.name;
  }
}

TEST_F(YardWays, TheSeedDecides)
{
  const MovingBody one = ways().add(BodyKind::kPerson, 7);
  const MovingBody same = ways().add(BodyKind::kPerson, 7);
  const MovingBody other = ways().add(BodyKind::kPerson, 8);
  EXPECT_EQ(one.way, same.way);
  EXPECT_EQ(one.times, same.times);
  EXPECT_NE(one.way, other.way);
}

TEST_F(YardWays, AnotherBodyIsAvoided)
{
  MovingBody block; // it fills all but the west
  block.name = "block";
  pcl6d::addBox(block.shape, {-1, -1, 0}, {1, 1, 1}, {"block", 0.5});
  block.way = {{2, 6, 0}, {8, 6, 0}};
  block.speed = 1;
  BodyWays some = ways();
  some.addOther(block);
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const MovingBody body = some.add(BodyKind::kPerson, seed);
    for (double time = 0; time <= 60; time += 0.1)
      EXPECT_GT(planDistance(body.poseAt(time), block.poseAt(time).translation()),
                std::sqrt(2.0));
  }
}

TEST_F(YardWays, WithoutRoomThereIsNoWay)
{
  GroundMap::Raster narrow = map_.raster();
  for (std::size_t i = 0; i < narrow.floors.size(); ++i)
    if (i / narrow.columns % 5 == 0) // lanes of 0.4 m
      narrow.floors[i] = std::numeric_limits<double>::quiet_NaN();
  const GroundMap lanes(narrow);
  BodyWays nowhere(lanes, track_, [](double, double, double, Random&) {
    return Eigen::Vector2d(0, 5);
  });
  EXPECT_THROW(nowhere.add(BodyKind::kPerson, 1), ComputeFailed);
  EXPECT_THROW(nowhere.add(BodyKind::kCar, 1), ComputeFailed);
}

TEST(ScannerTrack, IsStraightBetweenItsPlaces)
{
  ScannerTrack track;
  track.times = {1, 3};
  track.places = {{0, 0, 1}, {4, 0, 2}};
  EXPECT_EQ(track.placeAt(0), track.places[0]);
  EXPECT_EQ(track.placeAt(2), Eigen::Vector3d(2, 0, 1.5));
  EXPECT_EQ(track.placeAt(9), track.places[1]);
  EXPECT_NO_THROW(track.validate());
  track.times = {3, 3};
  EXPECT_THROW(track.validate(), BadArgument);
  track.times = {1};
  EXPECT_THROW(track.validate(), BadArgument);
  EXPECT_THROW(ScannerTrack().validate(), BadArgument);
  track.times = {0, 1.1e5};
  EXPECT_THROW(track.validate(), BadArgument) << "too long";
  track.times = {0, HUGE_VAL};
  EXPECT_THROW(track.validate(), BadArgument);
}
