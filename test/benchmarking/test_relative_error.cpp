// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories.h"

#include <pcl6d/benchmarking/relative_error.h>
#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::BadArgument;
using pcl6d::driftErrors;
using pcl6d::evaluateTrajectory;
using pcl6d::stepErrors;
using pcl6d::Trajectory;
using pcl6d::test::allPairs;
using pcl6d::test::kAngleTol;
using pcl6d::test::kPositionTol;
using pcl6d::test::moved;
using pcl6d::test::straightDrive;

namespace {
/** The drive with all positions scaled. */
Trajectory
scaledDrive(std::size_t count, double scale)
{
  auto drive = straightDrive(count);
  for (auto& pose : drive.poses)
    pose.translation() *= scale;
  return drive;
}

/** A winding drive with noise. */
Trajectory
winding(std::uint64_t noise_seed)
{
  pcl6d::Random random(noise_seed);
  Trajectory drive;
  for (int i = 0; i < 60; ++i)
    drive.poses.push_back(
        pcl6d::poseFromEuler({0.8 * i, 10 * std::sin(0.2 * i), 0.05 * i},
                             {0.1 * std::sin(0.3 * i), 0, 0.4 * i}) *
        pcl6d::test::randomPose(random, 0.2, 0.05));
  return drive;
}
} // namespace

TEST(StepErrors, OfAJumpAndBackAreTwoSteps)
{
  const auto reference = straightDrive(11);
  auto estimate = reference;
  estimate.poses[5].translation() += Eigen::Vector3d(0, 3, 4);
  const auto errors = stepErrors(estimate, reference, allPairs(11));
  ASSERT_EQ(errors.motions.size(), 10u);
  EXPECT_NEAR(errors.motions[4].translation, 5, kPositionTol);
  EXPECT_NEAR(errors.motions[5].translation, 5, kPositionTol);
  EXPECT_NEAR(errors.translation.rms, 5 * std::sqrt(0.2), kPositionTol);
  EXPECT_NEAR(errors.translation.mean, 1, kPositionTol);
  EXPECT_NEAR(errors.motions[7].path, 1, kPositionTol);
  EXPECT_EQ(errors.rotation.max, 0);
}

TEST(StepErrors, OfAConstantTurnAreThatTurn)
{
  // Each step of the estimate turns by 2 degrees more: T_i = (T Rz)^i.
  const double turn = M_PI / 90;
  const auto reference = straightDrive(8);
  Trajectory estimate{{Eigen::Isometry3d::Identity()}, {}};
  for (int i = 1; i < 8; ++i)
    estimate.poses.push_back(estimate.poses.back() * pcl6d::planarPose(1, 0, turn));
  const auto one = stepErrors(estimate, reference, allPairs(8));
  EXPECT_NEAR(one.rotation.mean, turn, kAngleTol);
  EXPECT_NEAR(one.rotation.max, turn, kAngleTol);
  EXPECT_NEAR(one.translation.max, 0, kPositionTol);
  // Two steps: the second metre leaves the first one's direction by the turn.
  const auto two = stepErrors(estimate, reference, allPairs(8), 2);
  ASSERT_EQ(two.motions.size(), 6u);
  EXPECT_NEAR(two.rotation.max, 2 * turn, kAngleTol);
  EXPECT_NEAR(two.translation.max, 2 * std::sin(turn / 2), kPositionTol);
}

TEST(StepErrors, GoOverComparedPosesOnly)
{
  const auto reference = straightDrive(9);
  auto estimate = straightDrive(3);
  for (auto& pose : estimate.poses)
    pose.translation() *= 4; // poses 0, 4 and 8 of the reference
  const auto errors = stepErrors(estimate, reference, {{0, 0}, {1, 4}, {2, 8}});
  ASSERT_EQ(errors.motions.size(), 2u);
  EXPECT_NEAR(errors.translation.max, 0, kPositionTol);
  EXPECT_NEAR(errors.motions[1].path, 4, kPositionTol);
}

TEST(DriftErrors, OfAWrongScaleAreItsShareOfTheStretch)
{
  // A stretch of 2.5 m ends at the first pose farther than that, 3 m away: its error is
  // 3 * 2 %, divided by the length asked for.
  const auto drift = driftErrors(
      scaledDrive(11, 1.02), straightDrive(11), allPairs(11), {2.5, 4.5, 100});
  ASSERT_EQ(drift.lengths.size(), 3u);
  EXPECT_EQ(drift.lengths[0].errors.motions.size(), 8u);
  EXPECT_EQ(drift.lengths[1].errors.motions.size(), 6u);
  EXPECT_EQ(drift.lengths[2].errors.motions.size(), 0u);
  EXPECT_EQ(drift.stretches, 14u);
  EXPECT_NEAR(drift.lengths[0].errors.translation.rms, 0.06, kPositionTol);
  EXPECT_NEAR(drift.lengths[0].translation_per_metre, 0.06 / 2.5, kPositionTol);
  EXPECT_NEAR(drift.lengths[1].translation_per_metre, 0.1 / 4.5, kPositionTol);
  EXPECT_NEAR(
      drift.translation_per_metre, (8 * 0.06 / 2.5 + 6 * 0.1 / 4.5) / 14, kPositionTol);
  EXPECT_NEAR(drift.path, 10, kPositionTol);
  EXPECT_NEAR(drift.end.translation, 0.2, kPositionTol);
  EXPECT_EQ(drift.rotation_per_metre, 0);
}

TEST(DriftErrors, AStretchEndsBehindItsLength)
{
  // Exactly 2 m is not longer than 2 m: the stretch goes on to 3 m, as in KITTI's kit.
  const auto drift =
      driftErrors(straightDrive(6), straightDrive(6), allPairs(6), {2.0});
  ASSERT_EQ(drift.lengths[0].errors.motions.size(), 3u);
  EXPECT_EQ(drift.lengths[0].errors.motions[0].to, 3u);
}

TEST(DriftErrors, OfATurnPerMetreAreThatTurn)
{
  const double turn = 0.01; // [rad] per step of 1 m
  Trajectory estimate{{Eigen::Isometry3d::Identity()}, {}};
  for (int i = 1; i < 21; ++i)
    estimate.poses.push_back(estimate.poses.back() * pcl6d::planarPose(1, 0, turn));
  const auto drift = driftErrors(estimate, straightDrive(21), allPairs(21), {4.999999});
  EXPECT_NEAR(drift.rotation_per_metre, 5 * turn / 4.999999, kAngleTol);
}

TEST(StretchLengths, AreEightOfARoundStepThatFitThePath)
{
  const auto ends = [](double path) {
    const auto lengths = pcl6d::stretchLengths(path);
    return lengths.size() == 8 ? std::pair(lengths.front(), lengths.back())
                               : std::pair(0.0, 0.0);
  };
  EXPECT_EQ(ends(3000), std::pair(100.0, 800.0));
  EXPECT_EQ(ends(800), std::pair(100.0, 800.0));
  EXPECT_EQ(ends(799), std::pair(50.0, 400.0));
  EXPECT_EQ(ends(64), std::pair(5.0, 40.0));
  EXPECT_EQ(ends(8), std::pair(1.0, 8.0));
  EXPECT_EQ(pcl6d::stretchLengths(0).size(), 0u);
  EXPECT_EQ(pcl6d::stretchLengths(std::nan("")).size(), 0u);
}

TEST(RelativeErrors, DoNotDependOnTheWorlds)
{
  const auto reference = winding(1), estimate = winding(2);
  const auto pairs = allPairs(reference.poses.size());
  const auto steps = stepErrors(estimate, reference, pairs);
  const auto drift = driftErrors(estimate, reference, pairs, {3, 7.5});
  ASSERT_GT(steps.translation.rms, 0.05);
  pcl6d::Random random(3);
  for (int i = 0; i < 10; ++i) {
    const auto a = pcl6d::test::randomPose(random, 50, 2),
               b = pcl6d::test::randomPose(random, 50, 3);
    const auto moved_steps = stepErrors(moved(a, estimate), moved(b, reference), pairs);
    const auto moved_drift =
        driftErrors(moved(a, estimate), moved(b, reference), pairs, {3, 7.5});
    EXPECT_NEAR(moved_steps.translation.rms, steps.translation.rms, kPositionTol);
    EXPECT_NEAR(moved_steps.rotation.max, steps.rotation.max, kAngleTol);
    EXPECT_NEAR(
        moved_drift.translation_per_metre, drift.translation_per_metre, kPositionTol);
    EXPECT_NEAR(moved_drift.rotation_per_metre, drift.rotation_per_metre, kAngleTol);
  }
}

TEST(EvaluateTrajectory, AteOfABlownUpSquareIsItsShift)
{
  // By symmetry the best rigid motion is none: each corner is 0.3 sqrt(2) m off.
  Trajectory reference, estimate;
  for (const auto& [x, y] : {std::pair(1, 1), {-1, 1}, {-1, -1}, {1, -1}}) {
    reference.poses.push_back(pcl6d::planarPose(x, y, 0));
    estimate.poses.push_back(pcl6d::planarPose(1.3 * x, 1.3 * y, 0));
  }
  pcl6d::Random random(4);
  const auto own = pcl6d::test::randomPose(random, 50, 2);
  const auto common = pcl6d::test::randomPose(random, 50, 1);
  for (const auto& evaluation :
       {evaluateTrajectory(estimate, reference),
        evaluateTrajectory(moved(own, estimate), reference),
        evaluateTrajectory(moved(common, estimate), moved(common, reference))}) {
    EXPECT_NEAR(
        evaluation.with_alignment.position.rms, 0.3 * std::sqrt(2), kPositionTol);
    EXPECT_NEAR(evaluation.length_ratios.scale, 1.3, kPositionTol);
    EXPECT_NEAR(evaluation.length_ratios.ratio.max, 0, kPositionTol);
    EXPECT_NEAR(evaluation.steps.translation.max, 0.6, kPositionTol);
  }
}

TEST(RelativeErrors, RefuseWhatIsOutside)
{
  const auto drive = straightDrive(3);
  EXPECT_THROW(stepErrors(drive, drive, {{0, 0}, {1, 3}}), BadArgument);
  EXPECT_THROW(stepErrors(drive, drive, allPairs(3), 0), BadArgument);
  EXPECT_THROW(driftErrors(drive, drive, allPairs(4)), BadArgument);
  for (const double length : {0.0, -1.0, std::nan(""), HUGE_VAL})
    EXPECT_THROW(driftErrors(drive, drive, allPairs(3), {length}), BadArgument);
  EXPECT_THROW(pcl6d::relativeError(drive, drive, allPairs(3), 0, 3), BadArgument);
}

TEST(RelativeErrors, OfOnePoseAreNone)
{
  const auto drive = straightDrive(1);
  EXPECT_EQ(stepErrors(drive, drive, allPairs(1)).translation.count, 0u);
  const auto drift = driftErrors(drive, drive, allPairs(1));
  EXPECT_EQ(drift.stretches, 0u);
  EXPECT_EQ(drift.path, 0);
  EXPECT_EQ(driftErrors(drive, drive, {}).stretches, 0u);
}
