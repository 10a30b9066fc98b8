// SPDX-License-Identifier: BSD-3-Clause
#include "support/poses.h"

#include <pcl6d/object_localization/pose_covariance.h>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>

namespace pcl6d {
namespace {
using Vector6d = Eigen::Matrix<double, 6, 1>;

PoseCovariance
someCovariance(Random& random)
{
  PoseCovariance root;
  for (int i = 0; i < 36; ++i)
    root(i / 6, i % 6) = 0.002 * random.normal();
  return root * root.transpose() + 1e-6 * PoseCovariance::Identity();
}

Vector6d
coordinates(const Eigen::Isometry3d& T)
{
  const EulerAngles angles = eulerFromRotation(T.linear());
  Vector6d x;
  x << T.translation(), angles.roll, angles.pitch, angles.yaw;
  return x;
}

/** The covariance of a function of poses that are drawn from a normal distribution. */
template <typename Function>
PoseCovariance
sampled(const PoseCovariance& covariance, const Eigen::Isometry3d& T, Function function)
{
  constexpr int kDraws = 40000;
  const PoseCovariance root = covariance.llt().matrixL();
  const Vector6d middle = coordinates(T), expected = coordinates(function(T));
  Random random(7);
  PoseCovariance sum = PoseCovariance::Zero();
  for (int i = 0; i < kDraws; ++i) {
    Vector6d draw;
    for (int k = 0; k < 6; ++k)
      draw[k] = random.normal();
    const Vector6d x = middle + root * draw;
    Vector6d off =
        coordinates(function(poseFromEuler(x.head<3>(), {x[3], x[4], x[5]}))) -
        expected;
    for (int k = 3; k < 6; ++k)
      off[k] = wrapAngle(off[k]);
    sum += off * off.transpose() / kDraws;
  }
  return sum;
}

/** In units of the standard deviations, so that small terms count as large ones do. */
void
expectAlike(const PoseCovariance& a, const PoseCovariance& b, double tolerance)
{
  const Vector6d sigma = b.diagonal().cwiseSqrt();
  const PoseCovariance off =
      sigma.cwiseInverse().asDiagonal() * (a - b) * sigma.cwiseInverse().asDiagonal();
  EXPECT_LT(off.cwiseAbs().maxCoeff(), tolerance);
}

const Eigen::Isometry3d kPose = poseFromEuler({1.2, -0.4, 0.8}, {0.4, -0.6, 3.1});
const Eigen::Isometry3d kMotion = poseFromEuler({-3, 2, 0.5}, {0.2, 0.3, -2});
} // namespace

TEST(PoseCovarianceOf, TheInverseTwiceIsTheSame)
{
  Random random(1);
  for (int i = 0; i < 20; ++i) {
    const PoseCovariance covariance = someCovariance(random);
    const Eigen::Isometry3d T = test::randomPose(random, 3, 0.8);
    const auto once = inverseCovariance(covariance, T);
    ASSERT_TRUE(once);
    const auto twice = inverseCovariance(*once, T.inverse());
    ASSERT_TRUE(twice);
    expectAlike(*twice, covariance, 1e-6);
  }
}

TEST(PoseCovarianceOf, TheInverseIsThatOfDraws)
{
  Random random(2);
  const PoseCovariance covariance = someCovariance(random);
  const auto inverse = [](const Eigen::Isometry3d& T) {
    return Eigen::Isometry3d(T.inverse());
  };
  expectAlike(
      *inverseCovariance(covariance, kPose), sampled(covariance, kPose, inverse), 0.03);
}

TEST(PoseCovarianceOf, AMovedPoseIsThatOfDrawsAndComesBack)
{
  Random random(3);
  const PoseCovariance covariance = someCovariance(random);
  const auto there = movedCovariance(covariance, kMotion, kPose);
  ASSERT_TRUE(there);
  const auto move = [](const Eigen::Isometry3d& T) {
    return Eigen::Isometry3d(kMotion * T);
  };
  expectAlike(*there, sampled(covariance, kPose, move), 0.03);
  const auto back = movedCovariance(*there, kMotion.inverse(), kMotion * kPose);
  ASSERT_TRUE(back);
  expectAlike(*back, covariance, 1e-6);
}

TEST(PoseCovarianceOf, NothingIsSaidAtThePoles)
{
  const PoseCovariance some = 1e-4 * PoseCovariance::Identity();
  const Eigen::Isometry3d level = Eigen::Isometry3d::Identity();
  const Eigen::Isometry3d pole = poseFromEuler({1, 0, 0}, {0.3, M_PI / 2, 0});
  EXPECT_FALSE(inverseCovariance(some, pole));
  EXPECT_FALSE(movedCovariance(some, level, pole));
  EXPECT_FALSE(movedCovariance(some, pole, level)); // where it is moved to
  EXPECT_TRUE(movedCovariance(some, pole.inverse(), pole) == std::nullopt);
  EXPECT_TRUE(inverseCovariance(some, level));
}

} // namespace pcl6d
