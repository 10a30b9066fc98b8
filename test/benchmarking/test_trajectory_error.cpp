// SPDX-License-Identifier: BSD-3-Clause
#include "support/poses.h"

#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/common/error.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using pcl6d::evaluateTrajectory;
using pcl6d::Random;
using pcl6d::Status;
using pcl6d::Trajectory;

namespace {
constexpr double kExtent = 50; // [m] half side of the cube that holds the positions
// Products of three rotations and sums of coordinates up to kExtent, in double.
constexpr double kAngleTol = 100 * std::numeric_limits<double>::epsilon(); // [rad]
constexpr double kPositionTol = kAngleTol * kExtent;                       // [m]

Trajectory
randomTrajectory(std::uint64_t seed, std::size_t count = 40)
{
  Random random(seed);
  Trajectory trajectory;
  for (std::size_t i = 0; i < count; ++i)
    trajectory.poses.push_back(
        pcl6d::test::randomPose(random, kExtent, random.uniform(0, M_PI)));
  return trajectory;
}

Trajectory
moved(const Eigen::Isometry3d& motion, Trajectory trajectory)
{
  for (auto& pose : trajectory.poses)
    pose = motion * pose;
  return trajectory;
}

Trajectory
noisy(Trajectory trajectory, double metres, double radians)
{
  Random random(99);
  for (auto& pose : trajectory.poses)
    pose = pose * pcl6d::test::randomPose(random, metres, radians);
  return trajectory;
}
} // namespace

TEST(PoseError, OfTheSamePoseIsZero)
{
  for (const auto& pose : randomTrajectory(1).poses) {
    const auto error = pcl6d::poseError(pose, pose);
    EXPECT_EQ(error.position, 0);
    EXPECT_LT(error.orientation, kAngleTol);
    EXPECT_EQ(error.yaw, 0);
  }
}

TEST(PoseError, IsTheRotationThatMadeItFromZeroToHalfATurn)
{
  Random random(2);
  for (const double angle : {0.0, 1e-12, 1e-7, 0.3, 2.0, M_PI - 1e-7, M_PI}) {
    SCOPED_TRACE("angle [rad] " + std::to_string(angle));
    const auto reference = pcl6d::test::randomPose(random, kExtent, 2.5);
    const auto error = pcl6d::poseError(
        reference * pcl6d::test::randomPose(random, 0, angle), reference);
    EXPECT_NEAR(error.orientation, angle, kAngleTol);
    EXPECT_LT(error.position, kPositionTol);
  }
}

TEST(PoseError, DoesNotDependOnTheSignOfTheQuaternion)
{
  // 2 acos(|q . q_ref|) by its definition, over turns whose quaternion changes sign.
  for (double turn = -6.25; turn < 6.3; turn += 0.1) {
    const Eigen::Quaterniond q(
        Eigen::AngleAxisd(turn, Eigen::Vector3d(1, 2, -2).normalized()));
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = q.toRotationMatrix();
    const double by_definition = 2 * std::acos(std::min(1.0, std::abs(q.w())));
    const double acos_tol = 1e-7; // acos near 1 keeps half the digits
    EXPECT_NEAR(pcl6d::poseError(pose, Eigen::Isometry3d::Identity()).orientation,
                by_definition,
                acos_tol)
        << "turn [rad] " << turn;
  }
}

TEST(PoseError, OfThePlaneLeavesOutHeightAndWrapsTheYaw)
{
  const auto reference = pcl6d::poseFromEuler({1, 2, 3}, {0, 0, M_PI - 0.1});
  const auto estimate = pcl6d::poseFromEuler({4, 6, 15}, {0, 0, -M_PI + 0.1});
  const auto error = pcl6d::poseError(estimate, reference);
  EXPECT_NEAR(error.position_2d, 5, kPositionTol);
  EXPECT_NEAR(error.position, 13, kPositionTol);
  EXPECT_NEAR(error.yaw, 0.2, kAngleTol);
  EXPECT_NEAR(error.orientation, 0.2, kAngleTol);
}

TEST(PoseError, OfATiltIsNoYaw)
{
  const auto error = pcl6d::poseError(pcl6d::poseFromEuler({0, 0, 0}, {0.3, -0.2, 1}),
                                      pcl6d::poseFromEuler({0, 0, 0}, {0, 0, 1}));
  EXPECT_NEAR(error.yaw, 0, kAngleTol);
  EXPECT_GT(error.orientation, 0.3);
}

TEST(EvaluateTrajectory, MeasuresAConstantOffsetAndAlignsItAway)
{
  const auto reference = randomTrajectory(3);
  Eigen::Isometry3d offset = Eigen::Isometry3d::Identity();
  offset.translation() << 3, -4, 12;
  const auto evaluation = evaluateTrajectory(moved(offset, reference), reference);
  const auto& raw = evaluation.without_alignment;
  EXPECT_NEAR(raw.position.rms, 13, kPositionTol);
  EXPECT_NEAR(raw.position.mean, 13, kPositionTol);
  EXPECT_NEAR(raw.position.max, 13, kPositionTol);
  EXPECT_NEAR(raw.position_2d.rms, 5, kPositionTol);
  EXPECT_LT(raw.orientation.max, kAngleTol);
  EXPECT_EQ(evaluation.alignment.status, Status::kOk);
  EXPECT_LT(evaluation.with_alignment.position.max, kPositionTol);
  EXPECT_LT(evaluation.with_alignment.orientation.max, kAngleTol);
}

TEST(EvaluateTrajectory, FindsTheMotionThatMadeTheEstimate)
{
  Random random(4);
  for (const double angle : {1e-6, 0.5, 3.0, M_PI}) {
    SCOPED_TRACE("angle [rad] " + std::to_string(angle));
    const auto reference = randomTrajectory(5);
    const auto motion = pcl6d::test::randomPose(random, kExtent, angle);
    const auto evaluation = evaluateTrajectory(moved(motion, reference), reference);
    for (const auto& error : evaluation.without_alignment.poses)
      EXPECT_NEAR(error.orientation, angle, kAngleTol);
    ASSERT_EQ(evaluation.alignment.status, Status::kOk);
    const auto left =
        pcl6d::distanceBetween(evaluation.alignment.transform, motion.inverse());
    EXPECT_LT(left.translation, kPositionTol);
    EXPECT_LT(left.rotation, kAngleTol);
    EXPECT_LT(evaluation.with_alignment.position.max, 2 * kPositionTol);
  }
}

TEST(EvaluateTrajectory, AlignedErrorsDoNotDependOnTheFrameOfTheEstimate)
{
  const auto reference = randomTrajectory(6);
  const auto estimate = noisy(reference, 0.5, 0.1);
  const auto before = evaluateTrajectory(estimate, reference).with_alignment;
  Random random(7);
  for (int i = 0; i < 20; ++i) {
    const auto motion = pcl6d::test::randomPose(random, 3 * kExtent, 2.0);
    const auto after =
        evaluateTrajectory(moved(motion, estimate), reference).with_alignment;
    EXPECT_NEAR(after.position.rms, before.position.rms, 10 * kPositionTol);
    EXPECT_NEAR(after.position.max, before.position.max, 10 * kPositionTol);
    EXPECT_NEAR(after.orientation.rms, before.orientation.rms, 10 * kAngleTol);
  }
}

TEST(EvaluateTrajectory, AlignmentNeverMakesThePositionRmsLarger)
{
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto reference = randomTrajectory(seed);
    const auto evaluation = evaluateTrajectory(noisy(reference, 5, 1), reference);
    EXPECT_LE(evaluation.with_alignment.position.rms,
              evaluation.without_alignment.position.rms);
  }
}

TEST(EvaluateTrajectory, AMirroredPathIsAlignedByAProperRotation)
{
  const auto reference = randomTrajectory(8);
  auto mirrored = reference;
  for (auto& pose : mirrored.poses)
    pose.translation().x() *= -1;
  const auto alignment = evaluateTrajectory(mirrored, reference).alignment;
  EXPECT_NEAR(alignment.transform.linear().determinant(), 1, 1e-12);
}

TEST(EvaluateTrajectory, AFewOrCollinearPosesAreOnlyShifted)
{
  const auto motion = pcl6d::poseFromEuler({1, 2, 3}, {0, 0, 0.5});
  const auto expectShiftOnly = [&](const Trajectory& reference, Status status) {
    const auto evaluation = evaluateTrajectory(moved(motion, reference), reference);
    EXPECT_EQ(evaluation.alignment.status, status);
    EXPECT_EQ(evaluation.alignment.transform.linear(), Eigen::Matrix3d::Identity());
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto& pose : reference.poses)
      mean += evaluation.alignment.transform * (motion * pose).translation() -
              pose.translation();
    EXPECT_LT(mean.norm(), 100 * kPositionTol);
  };
  expectShiftOnly(randomTrajectory(9, 1), Status::kTooFewPairs);
  expectShiftOnly(randomTrajectory(9, 2), Status::kTooFewPairs);
  Trajectory line, standing;
  for (int i = 0; i < 10; ++i) {
    line.poses.push_back(pcl6d::poseFromEuler({1.0 * i, 2.0 * i, -0.5 * i}, {}));
    standing.poses.push_back(pcl6d::poseFromEuler({1, 2, 3}, {0.1 * i, 0, 0}));
  }
  expectShiftOnly(line, Status::kRankDeficient);
  expectShiftOnly(standing, Status::kRankDeficient);
}

TEST(EvaluateTrajectory, ComparesOnlyPosesThatBelongTogether)
{
  auto reference = randomTrajectory(10, 5);
  reference.stamps = {0, 1, 2, 3, 4};
  const Trajectory estimate{{reference.poses[1], reference.poses[3]}, {1.001, 2.999}};
  const auto evaluation = evaluateTrajectory(estimate, reference);
  EXPECT_EQ(evaluation.without_alignment.position.count, 2u);
  EXPECT_EQ(evaluation.without_alignment.position.max, 0);
  EXPECT_EQ(evaluation.matching.unmatched_reference, 3u);
}

TEST(PathLength, IsTheSumOfTheSteps)
{
  Trajectory trajectory;
  EXPECT_EQ(pcl6d::pathLength(trajectory), 0);
  for (const auto& p : {Eigen::Vector3d(0, 0, 0),
                        Eigen::Vector3d(3, 4, 0),
                        Eigen::Vector3d(3, 4, 12),
                        Eigen::Vector3d(3, 4, 0)})
    trajectory.poses.push_back(pcl6d::poseFromEuler(p, {}));
  EXPECT_DOUBLE_EQ(pcl6d::pathLength(trajectory), 29);
}

TEST(TrajectoryErrors, RefusePairsOutsideTheTrajectories)
{
  const auto trajectory = randomTrajectory(11, 2);
  EXPECT_THROW(pcl6d::trajectoryErrors(trajectory, trajectory, {{0, 2}}),
               pcl6d::BadArgument);
  EXPECT_THROW(pcl6d::alignPositions(trajectory, trajectory, {{2, 0}}),
               pcl6d::BadArgument);
  EXPECT_EQ(pcl6d::alignPositions(trajectory, trajectory, {}).status,
            Status::kTooFewPairs);
}
