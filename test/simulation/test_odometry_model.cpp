// SPDX-License-Identifier: BSD-3-Clause
#include "support/poses.h"

#include <pcl6d/common/error.h>
#include <pcl6d/simulation/odometry_model.h>

#include <gtest/gtest.h>

namespace {
using pcl6d::OdometryOptions;
using pcl6d::Trajectory;
using pcl6d::wheelOdometry;

constexpr OdometryOptions kPerfect = {0, 0, 0, 0};

Trajectory
planarDrive(int count)
{
  Trajectory drive;
  pcl6d::Random random(5);
  Eigen::Isometry3d pose = pcl6d::planarPose(3, -2, 0.4);
  for (int i = 0; i < count; ++i) {
    drive.poses.push_back(pose);
    pose = pose * pcl6d::planarPose(random.uniform(0.5, 1.5),
                                    random.uniform(-0.1, 0.1),
                                    random.uniform(-0.5, 0.5));
  }
  return drive;
}
} // namespace

TEST(WheelOdometry, WithoutErrorIsTheTruthInThePlane)
{
  const Trajectory truth = planarDrive(50);
  const Trajectory odometry = wheelOdometry(truth, kPerfect, 1);
  ASSERT_EQ(odometry.poses.size(), truth.poses.size());
  for (std::size_t i = 0; i < truth.poses.size(); ++i) {
    const auto error = pcl6d::distanceBetween(truth.poses[i], odometry.poses[i]);
    EXPECT_LT(error.translation, 1e-12);
    EXPECT_LT(error.rotation, 1e-12);
  }
}

TEST(WheelOdometry, CountsTheWayAlongASlope)
{
  Trajectory truth;
  for (int i = 0; i < 3; ++i)
    truth.poses.push_back(pcl6d::poseFromEuler(
        {2.0 * i * std::cos(0.3), 0, 2 * i * std::sin(0.3)}, {0, -0.3, 0}));
  const Trajectory odometry = wheelOdometry(truth, kPerfect, 1);
  EXPECT_NEAR(odometry.poses[2].translation().x(), 4, 1e-12);
  EXPECT_EQ(odometry.poses[2].translation().z(), 0);
}

TEST(WheelOdometry, StaysInThePlaneWhateverTheTruth)
{
  pcl6d::Random random(6);
  Trajectory truth;
  for (int i = 0; i < 30; ++i)
    truth.poses.push_back(pcl6d::test::randomPose(random, 5, random.uniform(0, 1)));
  for (const auto& pose : wheelOdometry(truth, {}, 1).poses) {
    EXPECT_EQ(pose.translation().z(), 0);
    EXPECT_EQ(pose.linear().row(2), Eigen::RowVector3d::UnitZ());
    EXPECT_EQ(pose.linear().col(2), Eigen::Vector3d::UnitZ());
    EXPECT_TRUE(pcl6d::isRigid(pose, 1e-14));
  }
}

TEST(WheelOdometry, HasTheGivenSystematicErrors)
{
  Trajectory truth;
  for (int i = 0; i <= 10; ++i)
    truth.poses.push_back(pcl6d::planarPose(i, 0, 0));
  const Trajectory scaled = wheelOdometry(truth, {0.05, 0, 0, 0}, 1);
  EXPECT_NEAR(scaled.poses[10].translation().x(), 10.5, 1e-12);
  const Trajectory turned = wheelOdometry(truth, {0, 0.01, 0, 0}, 1);
  EXPECT_NEAR(pcl6d::eulerFromRotation(turned.poses[10].linear()).yaw, 0.1, 1e-12);
}

TEST(WheelOdometry, HasTheGivenRandomErrors)
{
  constexpr int kSteps = 20000;
  constexpr double kStep = 0.25; // [m]
  Trajectory truth;
  for (int i = 0; i <= kSteps; ++i)
    truth.poses.push_back(pcl6d::planarPose(kStep * i, 0, 0));
  const OdometryOptions options = {0, 0, 0.03, 0.02};
  const Trajectory odometry = wheelOdometry(truth, options, 9);
  Eigen::Array3d sum_sq(0, 0, 0);
  for (std::size_t i = 1; i <= kSteps; ++i) {
    const Eigen::Isometry3d motion =
        odometry.poses[i - 1].inverse() * odometry.poses[i];
    const double yaw = pcl6d::eulerFromRotation(motion.linear()).yaw;
    sum_sq +=
        Eigen::Array3d(motion.translation().x() - kStep, motion.translation().y(), yaw)
            .square();
  }
  const Eigen::Array3d spread = (sum_sq / kSteps).sqrt() / std::sqrt(kStep);
  const double relative = 5 / std::sqrt(2.0 * kSteps); // five standard errors
  EXPECT_NEAR(spread.x(), options.translation_noise, relative * 0.03);
  EXPECT_NEAR(spread.y(), options.translation_noise, relative * 0.03);
  EXPECT_NEAR(spread.z(), options.yaw_noise, relative * 0.02);
}

TEST(WheelOdometry, OfNoPosesIsEmpty)
{
  EXPECT_TRUE(wheelOdometry({}, {}, 1).poses.empty());
}

TEST(OdometryOptions, RefusesValuesOutOfRange)
{
  EXPECT_THROW(wheelOdometry({}, {1, 0, 0, 0}, 1), pcl6d::BadArgument);
  EXPECT_THROW(wheelOdometry({}, {0, -1, 0, 0}, 1), pcl6d::BadArgument);
  EXPECT_THROW(wheelOdometry({}, {0, 0, -0.1, 0}, 1), pcl6d::BadArgument);
  EXPECT_THROW(wheelOdometry({}, {0, 0, 0, std::nan("")}, 1), pcl6d::BadArgument);
}

TEST(WheelOdometry, HasTheGivenErrorOfTurns)
{
  Trajectory truth;
  for (int i = 0; i <= 10; ++i)
    truth.poses.push_back(pcl6d::planarPose(0, 0, 0.1 * i)); // on the spot
  const Trajectory odometry = wheelOdometry(truth, {0, 0, 0, 0, 0.05}, 1);
  EXPECT_NEAR(pcl6d::eulerFromRotation(odometry.poses[10].linear()).yaw, 1.05, 1e-12);
  EXPECT_THROW(wheelOdometry(truth, {0, 0, 0, 0, 1}, 1), pcl6d::BadArgument);
}

namespace {
using pcl6d::visualInertialOdometry;
using pcl6d::VisualInertialOptions;

constexpr VisualInertialOptions kPerfectVision = {0, 0, 0, 0, 0, 5};

// A winding way up and down, as on a hill.
Trajectory
hillyDrive(int count, double step)
{
  Trajectory drive;
  for (int i = 0; i < count; ++i) {
    const double s = step * i;
    drive.poses.push_back(
        pcl6d::poseFromEuler({s, 5 * std::sin(s / 20), 2 * std::sin(s / 10)},
                             {0.1 * std::sin(s / 3), -0.2 * std::cos(s / 10), s / 30}));
    drive.stamps.push_back(i);
  }
  return drive;
}
} // namespace

TEST(VisualInertialOdometry, WithoutErrorIsTheTruth)
{
  const Trajectory truth = hillyDrive(100, 0.5);
  const Trajectory odometry = visualInertialOdometry(truth, kPerfectVision, 1);
  EXPECT_EQ(odometry.stamps, truth.stamps);
  for (std::size_t i = 0; i < truth.poses.size(); ++i) {
    const auto error = pcl6d::distanceBetween(truth.poses[i], odometry.poses[i]);
    EXPECT_LT(error.translation, 1e-11);
    EXPECT_LT(error.rotation, 1e-11);
  }
}

TEST(VisualInertialOdometry, HasTheGivenSystematicErrors)
{
  Trajectory truth;
  for (int i = 0; i <= 10; ++i)
    truth.poses.push_back(pcl6d::planarPose(i, 0, 0));
  VisualInertialOptions options = kPerfectVision;
  options.scale_error = 0.05;
  EXPECT_NEAR(visualInertialOdometry(truth, options, 1).poses[10].translation().x(),
              10.5,
              1e-12);
  options = kPerfectVision;
  options.yaw_bias = 0.01;
  const auto turned = visualInertialOdometry(truth, options, 1).poses[10];
  EXPECT_NEAR(pcl6d::eulerFromRotation(turned.linear()).yaw, 0.1, 1e-12);
}

// Gravity holds roll and pitch, and nothing holds the rest.
TEST(VisualInertialOdometry, DriftsInYawAndPositionButNotInTilt)
{
  constexpr int kSteps = 20000;
  constexpr double kStep = 0.5; // [m]
  const Trajectory truth = hillyDrive(kSteps + 1, kStep);
  VisualInertialOptions options;
  options.yaw_bias = 0;
  const Trajectory odometry = visualInertialOdometry(truth, options, 3);
  double tilt_sq = 0, yaw_sq = 0, largest_tilt = 0;
  double last_yaw = 0;
  for (std::size_t i = 1; i <= kSteps; ++i) {
    const Eigen::Matrix3d R = truth.poses[i].linear();
    const Eigen::Matrix3d estimate = odometry.poses[i].linear();
    EXPECT_TRUE(pcl6d::isRigid(odometry.poses[i], 1e-12));
    // What is down: the third row of a rotation.
    const Eigen::Vector3d down = R.row(2), estimated_down = estimate.row(2);
    const double tilt = down.cross(estimated_down).norm();
    tilt_sq += tilt * tilt;
    largest_tilt = std::max(largest_tilt, tilt);
    const double yaw = pcl6d::rotationVector(estimate * R.transpose()).z();
    yaw_sq += (yaw - last_yaw) * (yaw - last_yaw);
    last_yaw = yaw;
  }
  // Two axes; about 2000 independent values, as 10 km are that many times tilt_way.
  EXPECT_NEAR(std::sqrt(tilt_sq / kSteps / 2), options.tilt_noise, 0.1 * 0.003);
  EXPECT_LT(largest_tilt, 6 * options.tilt_noise);
  // From step to step the tilt shows in the yaw of a tilted robot too, by a tenth.
  EXPECT_NEAR(std::sqrt(yaw_sq / kSteps / kStep), options.yaw_noise, 0.2 * 0.001);
  EXPECT_GT(
      (odometry.poses[kSteps].translation() - truth.poses[kSteps].translation()).norm(),
      1);
}

TEST(VisualInertialOdometry, HasTheGivenNoiseOfSteps)
{
  constexpr int kSteps = 20000;
  constexpr double kStep = 0.25; // [m]
  Trajectory truth;
  for (int i = 0; i <= kSteps; ++i)
    truth.poses.push_back(pcl6d::planarPose(kStep * i, 0, 0));
  VisualInertialOptions options = kPerfectVision;
  options.translation_noise = 0.02;
  const Trajectory odometry = visualInertialOdometry(truth, options, 9);
  Eigen::Array3d sum_sq(0, 0, 0);
  for (std::size_t i = 1; i <= kSteps; ++i)
    sum_sq += ((odometry.poses[i - 1].inverse() * odometry.poses[i]).translation() -
               Eigen::Vector3d(kStep, 0, 0))
                  .array()
                  .square();
  const double relative = 5 / std::sqrt(2.0 * kSteps); // five standard errors
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(std::sqrt(sum_sq[axis] / kSteps / kStep), 0.02, relative * 0.02);
}

TEST(VisualInertialOdometry, RefusesValuesOutOfRange)
{
  EXPECT_TRUE(visualInertialOdometry({}, {}, 1).poses.empty());
  for (const auto field : {&VisualInertialOptions::translation_noise,
                           &VisualInertialOptions::yaw_noise,
                           &VisualInertialOptions::tilt_noise,
                           &VisualInertialOptions::scale_error,
                           &VisualInertialOptions::yaw_bias,
                           &VisualInertialOptions::tilt_way}) {
    for (const double bad : {-1.0, std::nan("")}) {
      VisualInertialOptions options;
      options.*field = bad;
      EXPECT_THROW(visualInertialOdometry({}, options, 1), pcl6d::BadArgument);
    }
  }
}
