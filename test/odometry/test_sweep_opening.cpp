// SPDX-License-Identifier: BSD-3-Clause
// The first sweeps of a drive: their motion is known only when later sweeps tell it.
#include "corridor_sweeps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace {
using pcl6d::distanceBetween;
using pcl6d::Sweep;
using pcl6d::SweepStatus;
using pcl6d::TrackedSweep;
using pcl6d::test::CorridorSweeps;
using pcl6d::test::kSweepTime;

/** \return the pose of a drive that begins with a turn [rad], which slows down within the first sweep */
Eigen::Isometry3d
poseAfterTurn(double turn, double time)
{
  return CorridorSweeps::poseAt(time) *
         Eigen::AngleAxisd(turn * (1 - std::exp(-time / 0.03)),
                           Eigen::Vector3d::UnitZ());
}

/** The motion to the second sweep does not describe that within the first, and would leave the first
 * sweep turned by 0.03 rad against the others. */
Eigen::Isometry3d
poseInTurn(double time)
{
  return poseAfterTurn(0.06, time);
}
} // namespace

TEST(SweepTracker, ADriveMayBeginInATurn)
{
  CorridorSweeps corridor;
  pcl6d::SweepTracker tracker;
  TrackedSweep last;
  constexpr int kCount = 24;
  for (int i = 0; i < kCount; ++i)
    last = tracker.track(corridor.sweepAlong(poseInTurn, kSweepTime * i));
  const auto& opening = tracker.openingOfSegment();
  ASSERT_EQ(opening.size(), 20U);
  EXPECT_EQ(opening[0].status, SweepStatus::kFirst);
  EXPECT_TRUE(opening[0].is_keyframe);
  EXPECT_EQ(opening[9].status, SweepStatus::kTracked);
  const Eigen::Isometry3d truth =
      poseInTurn(0).inverse() * poseInTurn(kSweepTime * (kCount - 1));
  const auto error =
      distanceBetween(truth, opening[0].T_world_sweep.inverse() * last.T_world_sweep);
  EXPECT_LT(error.rotation, 0.01);
  EXPECT_LT(error.translation, 0.05);
}

// A turn too slight to stand out from the usual changes of velocity.
TEST(SweepTracker, TheFirstSweepIsMatchedInParts)
{
  constexpr double kTurn = 0.006; // [rad]
  const auto poseOf = [](double time) { return poseAfterTurn(kTurn, time); };
  CorridorSweeps corridor;
  pcl6d::SweepTracker tracker;
  for (int i = 0; i < 20; ++i)
    tracker.track(corridor.sweepAlong(poseOf, kSweepTime * i));
  const auto& opening = tracker.openingOfSegment();
  ASSERT_EQ(opening.size(), 20U);
  const Eigen::Isometry3d error = (poseOf(0).inverse() * poseOf(kSweepTime)).inverse() *
                                  opening[0].T_world_sweep.inverse() *
                                  opening[1].T_world_sweep;
  EXPECT_LT(std::abs(2 * Eigen::Quaterniond(error.linear()).z()), 0.1 * kTurn);
}

// The first sweep, which turns, distorts the map. All later sweeps fit it with the same wrong turn
// within, and each jumps back at its begin.
TEST(SweepTracker, ADistortedMapIsMadeAnew)
{
  CorridorSweeps corridor;
  pcl6d::SweepTracker tracker;
  constexpr int kCount = 20;
  for (int i = 0; i < kCount; ++i)
    tracker.track(corridor.sweepAlong(poseInTurn, kSweepTime * i));
  const auto& opening = tracker.openingOfSegment();
  ASSERT_EQ(opening.size(), 20U);
  double turn = 0; // mean error of the turns within the sweeps behind the first ten
  for (int i = 10; i < kCount; ++i) {
    const Eigen::Isometry3d truth = poseInTurn(kSweepTime * i).inverse() *
                                    poseInTurn(kSweepTime * (i + 1) - kSweepTime / 300);
    const auto& sweep = opening[static_cast<std::size_t>(i)];
    const Eigen::Isometry3d error =
        truth.inverse() * sweep.T_world_begin.inverse() * sweep.T_world_end;
    turn += Eigen::Quaterniond(error.linear()).z() * 2 / 10;
  }
  EXPECT_LT(std::abs(turn), 0.001);
}

// The pose of the first sweep is that of its begin: with the second sweep, only its path changes.
TEST(SweepTracker, TheSecondSweepTellsTheMotionWithinTheFirst)
{
  CorridorSweeps corridor;
  const auto sweeps = corridor.drive(2);
  pcl6d::SweepTracker tracker;
  EXPECT_FALSE(tracker.track(sweeps[0]).corrects_opening);
  const auto at_rest = tracker.openingOfSegment()[0].path;
  EXPECT_EQ(at_rest.poses.front().matrix(), at_rest.poses.back().matrix());
  EXPECT_TRUE(tracker.track(sweeps[1]).corrects_opening);
  const auto path = tracker.openingOfSegment()[0].path;
  EXPECT_NEAR(
      distanceBetween(path.poses.front(), path.poses.back()).translation, 0.15, 0.03);
}

TEST(SweepTracker, WithoutTimesTheOpeningStaysAsTracked)
{
  CorridorSweeps corridor;
  pcl6d::SweepTracker tracker;
  for (Sweep sweep : corridor.drive(24)) {
    sweep.times.clear();
    const TrackedSweep found = tracker.track(sweep);
    EXPECT_EQ(found.corrects_opening, *sweep.stamp == kSweepTime);
  }
  EXPECT_EQ(tracker.openingOfSegment()[0].T_world_sweep.matrix(),
            Eigen::Matrix4d::Identity());
}
