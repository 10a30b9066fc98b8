// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories.h"

#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/benchmarking/trajectory_resampling.h>
#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::BadArgument;
using pcl6d::resample;
using pcl6d::Trajectory;
using pcl6d::test::kAngleTol;
using pcl6d::test::kPositionTol;

namespace {
/** Poses at 0, 1, 2 and 5 s. */
Trajectory
drive()
{
  Trajectory drive;
  drive.stamps = {0, 1, 2, 5};
  for (const double t : drive.stamps)
    drive.poses.push_back(pcl6d::planarPose(2 * t, 0, 0.4 * t));
  return drive;
}
} // namespace

TEST(Resample, MovesAndTurnsEvenlyBetweenPoses)
{
  const auto result = resample(drive(), {0.25, 1, 1.5, 3}, HUGE_VAL);
  ASSERT_EQ(result.stamps, (std::vector<double>{0.25, 1, 1.5, 3}));
  for (std::size_t i = 0; i < result.poses.size(); ++i) {
    const auto left = pcl6d::distanceBetween(
        result.poses[i],
        pcl6d::planarPose(2 * result.stamps[i], 0, 0.4 * result.stamps[i]));
    EXPECT_LT(left.translation, kPositionTol);
    EXPECT_LT(left.rotation, kAngleTol);
  }
}

TEST(Resample, LeavesOutWhatLiesOutsideOrInAGap)
{
  const auto result = resample(drive(), {-0.1, 0, 1.5, 3, 5, 5.1}, 1);
  EXPECT_EQ(result.stamps, (std::vector<double>{0, 1.5, 5}));
}

TEST(Resample, RefusesBrokenStamps)
{
  auto broken = drive();
  broken.stamps[2] = 1;
  EXPECT_THROW(resample(broken, {0}, 1), BadArgument);
  EXPECT_THROW(resample({drive().poses, {}}, {0}, 1), BadArgument);
  EXPECT_THROW(resample(drive(), {1, 1}, 1), BadArgument);
  EXPECT_THROW(resample(drive(), {std::nan("")}, 1), BadArgument);
  EXPECT_THROW(resample(drive(), {0}, 0), BadArgument);
  EXPECT_THROW(resample(drive(), {0}, std::nan("")), BadArgument);
}

TEST(EvaluateTrajectory, ComparesWithTheReferenceInBetween)
{
  const auto reference = drive();
  Trajectory estimate;
  estimate.stamps = {0.5, 1.25, 9};
  for (const double t : estimate.stamps)
    estimate.poses.push_back(pcl6d::planarPose(2 * t, 0.1, 0.4 * t));
  pcl6d::TrajectoryEvaluationOptions options;
  EXPECT_THROW(evaluateTrajectory(estimate, reference, options), pcl6d::ComputeFailed);
  options.interpolation_gap = 1;
  const auto evaluation = evaluateTrajectory(estimate, reference, options);
  EXPECT_EQ(evaluation.matching.pairs.size(), 2u);
  EXPECT_EQ(evaluation.matching.unmatched_estimate, 1u);
  EXPECT_NEAR(evaluation.without_alignment.position.max, 0.1, kPositionTol);
  EXPECT_NEAR(evaluation.steps.translation.max, 0, kPositionTol)
      << "a shift of the world";
  EXPECT_NEAR(evaluation.path_length, 10, kPositionTol);

  options.loops = {{0, 1}};
  EXPECT_THROW(evaluateTrajectory(estimate, reference, options), BadArgument);
  options.loops.reset();
  estimate.stamps = {6, 7, 9};
  EXPECT_THROW(evaluateTrajectory(estimate, reference, options), pcl6d::ComputeFailed);
  estimate.stamps.clear();
  EXPECT_THROW(evaluateTrajectory(estimate, reference, options), BadArgument);
}
