// SPDX-License-Identifier: BSD-3-Clause
// Drives with exact truth, and laws that tracking keeps.
#include "corridor_sweeps.h"

#include <pcl6d/common/median.h>

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(SweepTracker, ThreadsDoNotChangeBits)
{
  CorridorSweeps corridor;
  const auto sweeps = corridor.drive(10);
  SweepTrackerOptions one, four;
  one.num_threads = 1;
  four.num_threads = 4;
  const auto a = trackAll(sweeps, one), b = trackAll(sweeps, four);
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    EXPECT_EQ(a[i].T_world_sweep.matrix(), b[i].T_world_sweep.matrix());
    EXPECT_EQ(a[i].covariance, b[i].covariance);
  }
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
