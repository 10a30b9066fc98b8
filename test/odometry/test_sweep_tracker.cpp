// SPDX-License-Identifier: BSD-3-Clause
// Drives with exact truth, and laws that tracking keeps.
#include "corridor_sweeps.h"

#include <pcl6d/common/median.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {
using pcl6d::distanceBetween;
using pcl6d::Sweep;
using pcl6d::SweepStatus;
using pcl6d::SweepTrackerOptions;
using pcl6d::TrackedSweep;
using pcl6d::test::CorridorSweeps;
using pcl6d::test::kSweepTime;
using pcl6d::test::trackAll;

Eigen::Isometry3d
truth(std::size_t i, double speed = 1.5)
{
  return CorridorSweeps::poseAt(0).inverse() *
         CorridorSweeps::poseAt(kSweepTime * static_cast<double>(i), speed);
}

std::vector<double>
stepErrors(const std::vector<TrackedSweep>& tracked, double speed = 1.5)
{
  std::vector<double> errors;
  for (std::size_t i = 1; i < tracked.size(); ++i)
    errors.push_back(distanceBetween(truth(i - 1, speed).inverse() * truth(i, speed),
                                     tracked[i - 1].T_world_sweep.inverse() *
                                         tracked[i].T_world_sweep)
                         .translation);
  return errors;
}
} // namespace

// A range has 5 mm of noise: a step is known to that.
TEST(SweepTracker, FollowsADriveWithMotionWithinItsSweeps)
{
  CorridorSweeps corridor;
  const auto tracked = trackAll(corridor.drive(80));
  EXPECT_EQ(tracked[0].status, SweepStatus::kFirst);
  for (std::size_t i = 1; i < tracked.size(); ++i)
    EXPECT_EQ(tracked[i].status, SweepStatus::kTracked) << i;
  EXPECT_LT(pcl6d::upperMedian(stepErrors(tracked)), 0.005);
  // 12 m of way. The pitch of the first sweeps is the weak one: their rings are sparse.
  const auto error = distanceBetween(truth(79), tracked.back().T_world_sweep);
  EXPECT_LT(error.translation, 0.1);
  EXPECT_LT(error.rotation, 0.02);
  // The end of a sweep is where the next one begins.
  EXPECT_LT(
      distanceBetween(tracked[40].T_world_end, tracked[41].T_world_begin).translation,
      0.02);
  EXPECT_EQ(std::count_if(tracked.begin(),
                          tracked.end(),
                          [](const TrackedSweep& s) { return s.free_directions > 0; }),
            0);
  const auto keyframes =
      std::count_if(tracked.begin(), tracked.end(), [](const TrackedSweep& s) {
        return s.is_keyframe;
      });
  EXPECT_TRUE(tracked[0].is_keyframe);
  EXPECT_GE(keyframes, 3);
  EXPECT_LE(keyframes, 20);
}

// A turn of 200 degrees a second begins and ends within sweeps: no linear change of velocity
// describes it, and would leave points 5 m away off by 20 cm and more.
TEST(SweepTracker, FollowsATurnThatBeginsWithinASweep)
{
  const auto pose = [](double time) {
    const double turn = std::clamp(time - 2.05, 0.0, 0.3) * pcl6d::radians(200);
    return Eigen::Isometry3d(CorridorSweeps::poseAt(time) *
                             Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
  };
  CorridorSweeps corridor;
  pcl6d::SweepTracker tracker;
  Eigen::Isometry3d before = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 30; ++i) {
    const TrackedSweep found = tracker.track(corridor.sweepAlong(pose, kSweepTime * i));
    const Eigen::Isometry3d truth =
        pose(kSweepTime * (i - 1)).inverse() * pose(kSweepTime * i);
    const auto error = distanceBetween(truth, before.inverse() * found.T_world_sweep);
    before = found.T_world_sweep;
    if (i < 15) // the first steps are rough
      continue;
    EXPECT_EQ(found.status, SweepStatus::kTracked) << i;
    EXPECT_LT(error.translation, 0.03) << i;
    // Behind the sudden end of the turn, where the begin and the velocity deviate together, the
    // begin is off by 0.31 degrees once.
    EXPECT_LT(error.rotation, pcl6d::radians(0.31)) << i;
  }
}

// At 6 m/s the slalom turns by up to 5 degrees a sweep: without times, a point 5 m away is off by
// 40 cm.
TEST(SweepTracker, TimesWithinSweepsMatter)
{
  constexpr double kFast = 6;
  CorridorSweeps corridor;
  auto sweeps = corridor.drive(40, kFast);
  const auto timed = trackAll(sweeps);
  EXPECT_EQ(timed.back().status, SweepStatus::kTracked);
  const double with_times = pcl6d::upperMedian(stepErrors(timed, kFast));
  EXPECT_LT(with_times, 0.01);
  for (Sweep& sweep : sweeps)
    sweep.times.clear();
  EXPECT_GT(pcl6d::upperMedian(stepErrors(trackAll(sweeps), kFast)), 2 * with_times);
}

TEST(SweepTracker, StandsStillWhereTheDriveDoes)
{
  CorridorSweeps corridor;
  const auto tracked = trackAll(corridor.drive(40, 0));
  for (const TrackedSweep& sweep : tracked) {
    const auto error =
        distanceBetween(Eigen::Isometry3d::Identity(), sweep.T_world_sweep);
    EXPECT_LT(error.translation, 0.005);
    EXPECT_LT(error.rotation, 0.002);
    EXPECT_EQ(sweep.is_keyframe, &sweep == &tracked.front());
  }
}

TEST(SweepTracker, EqualSweepsHaveEqualPoses)
{
  CorridorSweeps corridor;
  Sweep sweep = corridor.sweep(0, 0);
  std::vector<Sweep> sweeps(20, sweep);
  for (std::size_t i = 0; i < sweeps.size(); ++i)
    sweeps[i].stamp = kSweepTime * static_cast<double>(i);
  for (const TrackedSweep& tracked : trackAll(sweeps)) {
    EXPECT_NE(tracked.status, SweepStatus::kLost);
    EXPECT_LT(tracked.T_world_sweep.translation().norm(), 0.002);
  }
}

// By whole voxels of all sizes and a quarter turn the map stays the same but for rounding, which
// is 4e-6 m at 100 m, and moves some points of a sweep to the next voxel: less than its accuracy.
TEST(SweepTracker, ARigidlyMovedDriveHasRigidlyMovedPoses)
{
  CorridorSweeps corridor;
  auto sweeps = corridor.drive(30);
  SweepTrackerOptions options;
  options.voxel = 0.25;
  sweeps[0].prediction = Eigen::Isometry3d::Identity();
  const auto plain = trackAll(sweeps, options);
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.linear() << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  moved.translation() << 64, -96, 32;
  sweeps[0].prediction = moved;
  const auto there = trackAll(sweeps, options);
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const auto error =
        distanceBetween(moved * plain[i].T_world_sweep, there[i].T_world_sweep);
    EXPECT_LT(error.translation, 5e-3) << i;
    EXPECT_LT(error.rotation, 1e-3) << i;
  }
}

namespace {
/** \return a sweep of 24 rings at rest in a tunnel without features along x, 4 m wide, 3 m high */
Sweep
tunnelSweep(const Eigen::Isometry3d& pose, pcl6d::Random& random)
{
  constexpr int kColumns = 300;
  constexpr double kFarthest = 40; // [m]
  Sweep sweep;
  for (int column = 0; column < kColumns; ++column)
    for (int ring = 0; ring < 24; ++ring) {
      const double turn = 2 * M_PI * column / kColumns;
      const double up = pcl6d::radians(2.5 * ring - 28.75);
      const Eigen::Vector3d ray(
          std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up));
      const Eigen::Vector3d d = pose.linear() * ray, o = pose.translation();
      const double side = ((d.y() > 0 ? 2 : -2) - o.y()) / d.y();
      const double height = ((d.z() > 0 ? 2 : -1) - o.z()) / d.z();
      const double range = std::min(side, height) + 0.01 * random.normal();
      if (range < kFarthest)
        sweep.points.push_back((range * ray).cast<float>());
    }
  return sweep;
}
} // namespace

// Along the tunnel no surface tells the motion: it is the predicted one, which speeds up. Across,
// the predictions are off by 2 cm, and the walls decide.
TEST(SweepTracker, PredictionsDecideAlongATunnel)
{
  pcl6d::Random random(3);
  const auto poseAt = [](int i, double across) {
    return pcl6d::poseFromEuler({0.01 * i * i, 0.3 * std::sin(0.2 * i) + across, 0},
                                {0, 0, 0.05 * std::sin(0.3 * i)});
  };
  pcl6d::SweepTracker tracker;
  Eigen::Isometry3d last = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 30; ++i) {
    Sweep sweep = tunnelSweep(poseAt(i, 0), random);
    if (i > 0)
      sweep.prediction =
          last * (poseAt(i - 1, 0).inverse() * poseAt(i, i % 2 == 0 ? 0.02 : -0.02));
    const TrackedSweep found = tracker.track(sweep);
    EXPECT_NE(found.status, SweepStatus::kLost) << i;
    last = found.T_world_sweep;
  }
  const Eigen::Vector3d error =
      (poseAt(0, 0).inverse() * poseAt(29, 0)).translation() - last.translation();
  EXPECT_LT(std::abs(error.x()), 0.05); // of 8.4 m
  EXPECT_LT(error.tail<2>().norm(), 0.02);
}

// A drive that speeds up from rest: backward at constant velocity, the first sweep would lie metres
// off.
TEST(SweepTracker, AlongATunnelTheOpeningStaysAsPredicted)
{
  pcl6d::Random random(3);
  const auto poseAt = [](double time) {
    return pcl6d::poseFromEuler({2 * time * time, 0, 0}, {0, 0, 0});
  };
  pcl6d::SweepTracker tracker;
  TrackedSweep last;
  constexpr int kCount = 24;
  for (int i = 0; i < kCount; ++i) {
    Sweep sweep;
    sweep.stamp = kSweepTime * i;
    sweep.prediction = poseAt(*sweep.stamp);
    for (int k = 0; k < 6000; ++k) {
      const double time = kSweepTime * k / 6000, turn = random.uniform(-M_PI, M_PI);
      const Eigen::Isometry3d T_world_sensor = poseAt(*sweep.stamp + time);
      const double across = 2 + 0.002 * random.normal();
      const double wide = std::max(std::abs(std::cos(turn)), std::abs(std::sin(turn)));
      const Eigen::Vector3d point(T_world_sensor.translation().x() +
                                      random.uniform(-8, 8),
                                  across * std::cos(turn) / wide,
                                  across * std::sin(turn) / wide);
      sweep.points.push_back((T_world_sensor.inverse() * point).cast<float>());
      sweep.times.push_back(time);
    }
    last = tracker.track(sweep);
    ASSERT_NE(last.status, SweepStatus::kLost) << i;
  }
  const double way =
      (tracker.openingOfSegment()[0].T_world_sweep.inverse() * last.T_world_sweep)
          .translation()
          .x();
  EXPECT_NEAR(way, poseAt(kSweepTime * (kCount - 1)).translation().x(), 0.1); // 10.6 m
}

TEST(SweepTracker, ThreadsDoNotChangeBits)
{
  CorridorSweeps corridor;
  SweepTrackerOptions one, four;
  one.num_threads = 1;
  four.num_threads = 4;
  pcl6d::SweepTracker first(one), second(four);
  const auto expectSame = [](const TrackedSweep& a, const TrackedSweep& b) {
    EXPECT_EQ(a.T_world_sweep.matrix(), b.T_world_sweep.matrix());
    EXPECT_EQ(a.covariance, b.covariance);
    EXPECT_EQ(a.reduced, b.reduced);
  };
  for (const Sweep& sweep : corridor.drive(22)) // the opening is tracked backward
    expectSame(first.track(sweep), second.track(sweep));
  ASSERT_EQ(first.openingOfSegment().size(), 20U);
  for (std::size_t i = 0; i < 20; ++i)
    expectSame(first.openingOfSegment()[i], second.openingOfSegment()[i]);
}

TEST(SweepTracker, KeepsItsMapBounded)
{
  CorridorSweeps corridor;
  SweepTrackerOptions options;
  options.max_range = 4; // of 44 m
  pcl6d::SweepTracker tracker(options);
  std::size_t early = 0;
  for (std::size_t i = 0; i < 80; ++i) {
    tracker.track(corridor.sweep(kSweepTime * static_cast<double>(i)));
    if (i == 25)
      early = tracker.mapBytes();
  }
  EXPECT_GT(early, 0U);
  EXPECT_LT(tracker.mapBytes(), 3 * early);
}

TEST(SweepTracker, PosesAreAtTheStampsWhereverTimesBegin)
{
  CorridorSweeps corridor;
  auto sweeps = corridor.drive(30);
  const auto plain = trackAll(sweeps);
  for (Sweep& sweep : sweeps) { // the stamp is that of the end
    *sweep.stamp += kSweepTime;
    for (double& time : sweep.times)
      time -= kSweepTime;
  }
  const auto at_end = trackAll(sweeps);
  for (std::size_t i = 2; i < plain.size(); ++i)
    EXPECT_LT(
        distanceBetween(plain[i].T_world_end, at_end[i].T_world_sweep).translation,
        0.01)
        << i;
}

// A spinning sensor at 6 m/s turns and moves within a sweep: raw points are off by 40 cm.
TEST(SweepTracker, ReducedPointsAreWithoutTheMotionWithinTheSweep)
{
  constexpr double kFast = 6;
  CorridorSweeps corridor;
  const auto tracked = trackAll(corridor.drive(40, kFast));
  const Eigen::Isometry3d T_world_sensor = CorridorSweeps::poseAt(3.9, kFast);
  const auto& points = tracked.back().reduced;
  ASSERT_GT(points.size(), 1000U);
  std::vector<double> errors;
  for (const Eigen::Vector3f& point : points) {
    const Eigen::Vector3d ray = point.cast<double>();
    errors.push_back(std::abs(
        ray.norm() - corridor.range(T_world_sensor.translation(),
                                    T_world_sensor.linear() * ray.normalized())));
  }
  EXPECT_LT(pcl6d::upperMedian(errors), 0.02);
  Sweep none;
  pcl6d::SweepTracker tracker;
  EXPECT_TRUE(tracker.track(none).reduced.empty());
}

TEST(SweepTracker, DenseSweepsNeedNoOthersForASurface)
{
  CorridorSweeps corridor;
  pcl6d::SweepTracker sparse, dense;
  EXPECT_EQ(sparse.sweepsOfSurface(), 0U);
  sparse.track(corridor.sweep(0)); // 2.5 degrees from ring to ring
  EXPECT_GE(sparse.sweepsOfSurface(), 3U);
  EXPECT_LE(sparse.sweepsOfSurface(), 6U);
  const auto pose = [](double time) { return CorridorSweeps::poseAt(time); };
  dense.track(corridor.sweepAlong(pose, 0, 0.4));
  EXPECT_EQ(dense.sweepsOfSurface(), 1U);
}
