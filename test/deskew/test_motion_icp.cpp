// SPDX-License-Identifier: BSD-3-Clause
// A scan that was taken on the move against a map.
#include "support/moving_room.h"

#include <pcl6d/common/error.h>
#include <pcl6d/deskew/motion_icp.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace {
using pcl6d::MotionIcpOptions;
using pcl6d::MotionStart;
using pcl6d::Status;
using pcl6d::TimedPoints;
using pcl6d::Trajectory;
using pcl6d::test::MovingScanner;

// A knot is found no worse than the noise of a single point: cells at edges are no planes.
constexpr double kTolerance = 5e-3; // [m] of a point 3 m away

struct MotionIcp : testing::Test {
  pcl6d::Random random{7};
  MovingScanner scanner;
  pcl6d::SurfaceMap map = pcl6d::test::roomMap(scanner, random);
  TimedPoints scan = scanner.sweep(0, random);
  MotionIcpOptions options = [] {
    MotionIcpOptions ours;
    ours.noise = 0.005;
    return ours;
  }();

  // A start at the pose of the begin, as if the scanner stood still.
  MotionStart
  resting(const std::vector<double>& stamps) const
  {
    MotionStart start;
    start.knots.stamps = stamps;
    start.knots.poses.assign(stamps.size(), scanner.poseAt(0));
    return start;
  }

  void
  expectTruth(const Trajectory& knots, double tolerance = kTolerance) const
  {
    for (std::size_t k = 0; k < knots.poses.size(); ++k)
      EXPECT_LT(scanner.errorOf(knots.poses[k], knots.stamps[k]), tolerance)
          << "knot " << k;
  }
};
} // namespace

TEST_F(MotionIcp, FindsTheMotionThatTheScanWasMadeWith)
{
  const auto result = pcl6d::motionIcp(map, scan, resting({0, 0.1}), options);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_GT(result.pairs, scan.points.size() / 2);
  EXPECT_LT(result.deviation, 1.5);
  expectTruth(result.knots);
}

TEST_F(MotionIcp, FindsAFastMotionAtSeveralKnots)
{
  scanner.turn = 2; // [s], 1.7 m and 46 degrees
  scan = scanner.sweep(0, random);
  MotionStart start = resting({0, 0.5, 1, 1.5, 2});
  for (std::size_t k = 0; k < 5; ++k) { // 2 dm and 6 degrees off at the end
    start.knots.poses[k] = scanner.poseAt(0.88 * start.knots.stamps[k]);
    start.terms = pcl6d::elasticTermsWithin(
        start.knots.stamps, 0, pcl6d::MotionNoise::plausible());
  }
  const auto result = pcl6d::motionIcp(map, scan, start, options);
  EXPECT_EQ(result.status, Status::kOk);
  expectTruth(result.knots, 2 * kTolerance); // the ends have an eighth of the points
}

TEST_F(MotionIcp, AScanThatStoodStillGetsNoMotion)
{
  scanner.velocity.setZero();
  scanner.turning.setZero();
  scan = scanner.sweep(0, random);
  const auto result = pcl6d::motionIcp(map, scan, resting({0, 0.1}), options);
  EXPECT_EQ(result.status, Status::kOk);
  const auto within =
      pcl6d::distanceBetween(result.knots.poses[0], result.knots.poses[1]);
  EXPECT_LT(within.translation, kTolerance);
  EXPECT_LT(3 * within.rotation, kTolerance);
}

TEST_F(MotionIcp, TimeThatRunsBackwardsSwapsBeginAndEnd)
{
  const auto forwards = pcl6d::motionIcp(map, scan, resting({0, 0.1}), options);
  TimedPoints reversed = scan;
  for (double& time : reversed.times)
    time = 0.1 - time;
  const auto backwards = pcl6d::motionIcp(map, reversed, resting({0, 0.1}), options);
  for (const std::size_t k : {0, 1}) {
    const auto off =
        pcl6d::distanceBetween(forwards.knots.poses[k], backwards.knots.poses[1 - k]);
    EXPECT_LT(off.translation, 1e-4); // both have converged to so much
    EXPECT_LT(off.rotation, 1e-4);
  }
}

TEST_F(MotionIcp, HasTheSameBitsForAnyNumberOfThreads)
{
  options.num_threads = 1;
  const auto one = pcl6d::motionIcp(map, scan, resting({0, 0.1}), options);
  for (const unsigned threads : {2u, 8u}) {
    options.num_threads = threads;
    const auto more = pcl6d::motionIcp(map, scan, resting({0, 0.1}), options);
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_TRUE(one.knots.poses[k].matrix() == more.knots.poses[k].matrix());
  }
}

// Sliding on a floor, and turning on it, changes nothing.
TEST_F(MotionIcp, WhatASinglePlaneDoesNotFixFollowsFromTheRules)
{
  scanner.room.walls = {Eigen::Vector3d(-50, -50, -1), Eigen::Vector3d(50, 50, 50)};
  scanner.room.pillars.clear();
  const auto isNear = [](const Eigen::Vector3f& p) { return p.norm() < 6; };
  TimedPoints floor;
  scan = scanner.sweep(0, random);
  for (std::size_t i = 0; i < scan.points.size(); ++i)
    if (isNear(scan.points[i])) {
      floor.points.push_back(scan.points[i]);
      floor.times.push_back(scan.times[i]);
    }
  pcl6d::SurfaceMap plane;
  std::vector<Eigen::Vector3d> world;
  for (int i = 0; i < 20000; ++i)
    world.emplace_back(random.uniform(-8, 8), random.uniform(-8, 8), -1);
  plane.add(world);
  MotionStart start = resting({0, 0.1});
  EXPECT_EQ(pcl6d::motionIcp(plane, floor, start, options).status,
            Status::kRankDeficient);
  start.held = scanner.knots({-0.1, 0}); // as the scan before ended
  start.terms = pcl6d::elasticTermsBetween(
      {0, -0.1}, {1, 0}, {2, 0}, {3, 0.1}, pcl6d::MotionNoise::usual(), 1e-3, 1e-3);
  const auto result = pcl6d::motionIcp(plane, floor, start, options);
  EXPECT_EQ(result.status, Status::kOk);
  expectTruth(result.knots, 0.01);
}

TEST_F(MotionIcp, TooFewPointsGiveTheStart)
{
  TimedPoints few{{scan.points[0], scan.points[1]}, {scan.times[0], scan.times[1]}};
  const MotionStart start = resting({0, 0.1});
  const auto result = pcl6d::motionIcp(map, few, start, options);
  EXPECT_EQ(result.status, Status::kTooFewPairs);
  EXPECT_TRUE(result.knots.poses[1].matrix() == start.knots.poses[1].matrix());
  EXPECT_EQ(pcl6d::motionIcp(pcl6d::SurfaceMap(), scan, start, options).status,
            Status::kTooFewPairs);
}

TEST_F(MotionIcp, PointsThatAreNotFiniteDoNotCount)
{
  const auto expected = pcl6d::motionIcp(map, scan, resting({0, 0.1}), options);
  scan.points[17] = Eigen::Vector3f(NAN, 0, 0);
  const auto result = pcl6d::motionIcp(map, scan, resting({0, 0.1}), options);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_LE(result.pairs, expected.pairs);
  expectTruth(result.knots);
}

TEST_F(MotionIcp, RefusesWhatBreaksARule)
{
  const MotionStart start = resting({0, 0.1});
  const auto refused = [&](const TimedPoints& points,
                           const MotionStart& from,
                           const MotionIcpOptions& with) {
    EXPECT_THROW(pcl6d::motionIcp(map, points, from, with), pcl6d::BadArgument);
  };
  TimedPoints untimed = scan;
  untimed.times.pop_back();
  refused(untimed, start, options);
  refused(scan, resting({0}), options);
  refused(scan, resting({0.1, 0}), options);
  MotionStart elsewhere = start;
  elsewhere.terms = {pcl6d::rigidTerm(0, 2, 1)};
  refused(scan, elsewhere, options);
  for (auto change : std::vector<void (*)(MotionIcpOptions&)>{
           [](MotionIcpOptions& o) { o.max_iterations = 0; },
           [](MotionIcpOptions& o) { o.noise = 0; },
           [](MotionIcpOptions& o) { o.max_distance_start = 0; },
           [](MotionIcpOptions& o) { o.distance_decay = 1; },
           [](MotionIcpOptions& o) { o.max_deviations = 0; },
           [](MotionIcpOptions& o) { o.epsilon = 0; }}) {
    MotionIcpOptions broken = options;
    change(broken);
    refused(scan, start, broken);
  }
}

TEST_F(MotionIcp, UndoneScansAreThoseOfOnePose)
{
  const Trajectory truth = scanner.knots({0, 0.1});
  scanner.sigma = 0;
  scan = scanner.sweep(0, random);
  const auto undone = pcl6d::undoMotion(scan, truth, 0.03);
  const auto world = pcl6d::worldPoints(scan, truth);
  const Eigen::Isometry3d pose = scanner.poseAt(0.03);
  for (std::size_t i = 0; i < undone.size(); i += 50) {
    // All rays end on a surface that is met from the one pose, too, or is hidden from it.
    EXPECT_LT((pose * undone[i].cast<double>() - world[i]).norm(), 1e-5); // float
    const Eigen::Vector3d ray = (world[i] - pose.translation()).normalized();
    EXPECT_LT(scanner.room.range(pose.translation(), ray),
              (world[i] - pose.translation()).norm() + 1e-4);
  }
  TimedPoints untimed = scan;
  untimed.times.clear();
  EXPECT_THROW(pcl6d::undoMotion(untimed, truth, 0), pcl6d::BadArgument);
  EXPECT_THROW(pcl6d::worldPoints(untimed, truth), pcl6d::BadArgument);
}
