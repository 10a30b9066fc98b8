// SPDX-License-Identifier: BSD-3-Clause
#include "support/pairs.h"

#include <pcl6d/registration/pose_information.h>
#include <pcl6d/registration/rigid_minimiser.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

using pcl6d::poseCovariance;
using pcl6d::PoseCovariance;
using pcl6d::Random;
using pcl6d::test::movedPairs;
using pcl6d::test::Pairs;
using pcl6d::test::randomPoints;

namespace {
constexpr double kSigma = 0.01; // [m] noise of the target points per axis
constexpr int kTrials = 4000;
constexpr std::size_t kPairs = 12;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/** The error of a pose in the parameters of the covariance, near the truth. */
Vector6
errorOf(const Eigen::Isometry3d& pose, const Eigen::Isometry3d& truth)
{
  const auto a = pcl6d::eulerFromRotation(pose.linear());
  const auto b = pcl6d::eulerFromRotation(truth.linear());
  Vector6 error;
  error.head<3>() = pose.translation() - truth.translation();
  error.tail<3>() << pcl6d::wrapAngle(a.roll - b.roll), a.pitch - b.pitch,
      pcl6d::wrapAngle(a.yaw - b.yaw);
  return error;
}

/** Sums at a pose: source points already in the world. */
pcl6d::PairSums
sumsAt(const Pairs& pairs, const Eigen::Isometry3d& pose)
{
  Pairs moved = pairs;
  for (auto& d : moved.source)
    d = pose * d;
  return moved.sums();
}
} // namespace

TEST(PoseCovariance, IsTheSpreadOfRepeatedFits)
{
  // C7 of algorithms.md: 12 pairs, fitted again and again with new noise.
  Random random(1);
  const auto source = randomPoints(random, kPairs, 5, {8, 3, -2});
  const Eigen::Isometry3d truth = pcl6d::poseFromEuler({20, -30, 5}, {0.4, -0.7, 2.1});
  PoseCovariance sample = PoseCovariance::Zero(), predicted = PoseCovariance::Zero();
  for (int trial = 0; trial < kTrials; ++trial) {
    const Pairs pairs = movedPairs(source, truth, random, kSigma);
    const auto fit = pcl6d::minimiseByQuaternion(pairs.sums());
    const Vector6 error = errorOf(fit.transform, truth);
    sample += error * error.transpose() / kTrials;
    const auto covariance = poseCovariance(sumsAt(pairs, fit.transform), fit.transform);
    ASSERT_TRUE(covariance);
    predicted += *covariance / kTrials;
  }
  // The sample covariance of n normal errors has the relative standard deviation
  // sqrt(1 / n) (entries scaled by the sigmas: sqrt((1 + r^2) / n)); five of the larger.
  const double tolerance = 5 * std::sqrt(2.0 / kTrials);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      SCOPED_TRACE("entry " + std::to_string(i) + ", " + std::to_string(j));
      const double scale = std::sqrt(predicted(i, i) * predicted(j, j));
      EXPECT_NEAR(sample(i, j) / scale, predicted(i, j) / scale, tolerance);
    }
}

TEST(PoseCovariance, IsSymmetricAndPositive)
{
  Random random(2);
  const Eigen::Isometry3d truth = pcl6d::poseFromEuler({1, 2, 3}, {-1, 0.5, -3});
  const Pairs pairs = movedPairs(randomPoints(random, 100, 5), truth, random, kSigma);
  const auto covariance = poseCovariance(sumsAt(pairs, truth), truth);
  ASSERT_TRUE(covariance);
  EXPECT_LT((*covariance - covariance->transpose()).norm(), 1e-12 * covariance->norm());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<PoseCovariance>(*covariance).eigenvalues()(0),
            0);
}

TEST(PoseCovariance, IsFixedByAPlane)
{
  Random random(3);
  auto source = randomPoints(random, 100, 5);
  for (auto& d : source)
    d.z() = 0;
  const Eigen::Isometry3d truth = pcl6d::poseFromEuler({1, 2, 3}, {0.1, 0.2, 0.3});
  const Pairs pairs = movedPairs(source, truth, random, kSigma);
  EXPECT_TRUE(poseCovariance(sumsAt(pairs, truth), truth)) << "rank 6, check C16";
}

TEST(PoseCovariance, IsNotGivenForALineOrFewerThanThreePairs)
{
  Random random(4);
  const Eigen::Isometry3d truth = pcl6d::poseFromEuler({1, 2, 3}, {0.1, 0.2, 0.3});
  std::vector<Eigen::Vector3d> line;
  for (int i = 0; i < 20; ++i)
    line.push_back(Eigen::Vector3d(1, 2, 3) + i * Eigen::Vector3d(0.3, -0.1, 0.7));
  EXPECT_FALSE(
      poseCovariance(sumsAt(movedPairs(line, truth, random, kSigma), truth), truth));
  const Pairs two = movedPairs(randomPoints(random, 2, 5), truth, random, kSigma);
  EXPECT_FALSE(poseCovariance(sumsAt(two, truth), truth));
  EXPECT_FALSE(poseCovariance(Pairs().sums(), truth));
  const Pairs same = movedPairs({5, {1, 1, 1}}, truth, random, kSigma);
  EXPECT_FALSE(poseCovariance(sumsAt(same, truth), truth));
}

TEST(PoseCovariance, IsNotGivenAtAPitchOfARightAngle)
{
  Random random(5);
  const auto source = randomPoints(random, 100, 5);
  const auto given = [&](double pitch) {
    const Eigen::Isometry3d truth = pcl6d::poseFromEuler({1, 2, 3}, {0.1, pitch, 0.3});
    const Pairs pairs = movedPairs(source, truth, random, kSigma);
    return poseCovariance(sumsAt(pairs, truth), truth).has_value();
  };
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_FALSE(given(sign * M_PI / 2));
    EXPECT_FALSE(given(sign * (M_PI / 2 - 0.0009)));
    EXPECT_TRUE(given(sign * (M_PI / 2 - 0.0011)));
  }
}
