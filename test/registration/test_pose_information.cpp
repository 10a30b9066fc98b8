// SPDX-License-Identifier: BSD-3-Clause
#include "support/fit_oracles.h"
#include "support/pairs.h"

#include <pcl6d/registration/plane_minimiser.h>
#include <pcl6d/registration/pose_information.h>
#include <pcl6d/registration/rigid_minimiser.h>

#include <Eigen/Cholesky>
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
constexpr std::size_t kMeasured = 12;
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
  // 12 pairs, fitted again and again with new noise.
  Random random(1);
  const auto source = randomPoints(random, kMeasured, 5, {8, 3, -2});
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
  EXPECT_GT(pcl6d::test::smallestEigenvalue(*covariance), 0);
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

namespace {
/** Sums of pairs on planes of the given normals; source points already in the world. */
template <typename NormalOf>
pcl6d::PlaneSums
planeSumsAt(Random& random, int count, double sigma, NormalOf normal_of)
{
  pcl6d::PlaneAccumulator sums;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d p = pcl6d::test::randomVector(random, 5);
    const Eigen::Vector3d n = normal_of(i).normalized();
    sums.add(p, p + sigma * random.normal() * n, n);
  }
  return sums.sums();
}

const Eigen::Isometry3d kPose = pcl6d::poseFromEuler({20, -30, 5}, {0.4, -0.7, 2.1});
} // namespace

TEST(PoseInformation, IsTheInverseOfTheCovariance)
{
  Random random(10);
  const auto expectInverse = [](const auto& sums) {
    const auto information = poseInformation(sums, kPose);
    const auto covariance = poseCovariance(sums, kPose);
    ASSERT_TRUE(information);
    ASSERT_TRUE(covariance);
    // In units in which both have ones on their diagonals.
    const Vector6 unit = covariance->diagonal().cwiseSqrt();
    const PoseCovariance product = unit.cwiseInverse().asDiagonal() * *covariance *
                                   *information * unit.asDiagonal();
    EXPECT_LT((product - PoseCovariance::Identity()).norm(), 1e-7);
    EXPECT_LT((*information - information->transpose()).norm(),
              1e-12 * information->norm());
  };
  const Pairs pairs = movedPairs(randomPoints(random, 100, 5), kPose, random, kSigma);
  expectInverse(sumsAt(pairs, kPose));
  expectInverse(planeSumsAt(
      random, 300, kSigma, [&](int) { return pcl6d::test::randomVector(random, 1); }));
}

TEST(PoseInformation, IsTheCurvatureOfTheError)
{
  // Half the second derivative of the error by the pose parameters, over s^2.
  Random random(11);
  const Pairs pairs = movedPairs(randomPoints(random, 50, 5), kPose, random, kSigma);
  const auto angles = pcl6d::eulerFromRotation(kPose.linear());
  const auto errorAt = [&](const Vector6& x) {
    const auto pose = pcl6d::poseFromEuler(
        kPose.translation() + x.head<3>(),
        {angles.roll + x(3), angles.pitch + x(4), angles.yaw + x(5)});
    double sum = 0;
    for (std::size_t i = 0; i < pairs.source.size(); ++i)
      sum += (pairs.target[i] - pose * pairs.source[i]).squaredNorm();
    return sum;
  };
  const auto sums = sumsAt(pairs, kPose);
  const double variance = sums.errorSq(Eigen::Isometry3d::Identity()) / (3 * 50 - 6);
  const auto information = poseInformation(sums, kPose);
  ASSERT_TRUE(information);
  constexpr double h = 1e-3;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const Vector6 a = h * Vector6::Unit(i), b = h * Vector6::Unit(j);
      const double second =
          (errorAt(a + b) - errorAt(a - b) - errorAt(b - a) + errorAt(-a - b)) /
          (8 * h * h);
      // Gauss-Newton leaves out residual times curvature: sigma of a lever of 9 m.
      EXPECT_NEAR(second / variance,
                  (*information)(i, j),
                  0.01 * std::sqrt((*information)(i, i) * (*information)(j, j)))
          << i << ", " << j;
    }
}

TEST(PoseInformation, IsSingularForAPlane)
{
  Random random(12);
  pcl6d::PlaneAccumulator accumulator;
  const Eigen::Vector3d n = Eigen::Vector3d(1, -2, 3).normalized();
  for (int i = 0; i < 200; ++i) {
    Eigen::Vector3d p = pcl6d::test::randomVector(random, 5);
    p -= n * n.dot(p);
    accumulator.add(p, p + kSigma * random.normal() * n, n);
  }
  const auto sums = accumulator.sums();
  EXPECT_FALSE(poseCovariance(sums, kPose));
  const auto information = poseInformation(sums, kPose);
  ASSERT_TRUE(information);
  const Eigen::SelfAdjointEigenSolver<PoseCovariance> solver(*information);
  EXPECT_LT(std::abs(solver.eigenvalues()(2)), 1e-9 * solver.eigenvalues()(5));
  EXPECT_GT(solver.eigenvalues()(3), 1e-6 * solver.eigenvalues()(5));
  // To slide along the plane costs nothing.
  Vector6 slide = Vector6::Zero();
  slide.head<3>() = n.unitOrthogonal();
  EXPECT_LT(std::abs(slide.dot(*information * slide)), 1e-9 * information->norm());
}

TEST(PoseInformation, IsNotGivenWithoutPairsOrError)
{
  Random random(13);
  EXPECT_FALSE(poseInformation(pcl6d::PairSums(), kPose));
  EXPECT_FALSE(poseInformation(pcl6d::PlaneSums(), kPose));
  const auto normal = [&](int) { return pcl6d::test::randomVector(random, 1); };
  EXPECT_FALSE(poseInformation(planeSumsAt(random, 2, kSigma, normal), kPose));
  EXPECT_FALSE(poseInformation(planeSumsAt(random, 300, 0, normal), kPose));
  const auto up = pcl6d::poseFromEuler({1, 2, 3}, {0.1, M_PI / 2, 0.3});
  EXPECT_FALSE(poseInformation(planeSumsAt(random, 300, kSigma, normal), up));
}

TEST(PoseCovariance, IsNotGivenWithoutError)
{
  // As the inverse of the information; a covariance of zero would claim certainty.
  Random random(14);
  const auto normal = [&](int) { return pcl6d::test::randomVector(random, 1); };
  EXPECT_FALSE(poseCovariance(planeSumsAt(random, 300, 0, normal), kPose));
}

TEST(PoseInformation, OfPlanesIsTheSpreadOfRepeatedFits)
{
  // One room, fitted again and again with new noise along the normals.
  Random random(15);
  constexpr int kPlanes = 30;
  std::vector<Eigen::Vector3d> points, normals;
  for (int i = 0; i < kPlanes; ++i) {
    points.push_back(pcl6d::test::randomVector(random, 5));
    normals.push_back(pcl6d::test::randomVector(random, 1).normalized());
  }
  PoseCovariance sample = PoseCovariance::Zero(), predicted = PoseCovariance::Zero();
  for (int trial = 0; trial < kTrials; ++trial) {
    pcl6d::PlaneAccumulator accumulator;
    for (int i = 0; i < kPlanes; ++i)
      accumulator.add(
          points[i], points[i] + kSigma * random.normal() * normals[i], normals[i]);
    const auto sums = accumulator.sums();
    const auto pose = pcl6d::planeStepByHelix(sums).transform * kPose;
    const Vector6 error = errorOf(pose, kPose);
    sample += error * error.transpose() / kTrials;
    // The error before the step is known: replace it by that after it.
    auto at_rest = sums;
    at_rest.residual_sq -= sums.b.dot(sums.A.ldlt().solve(sums.b));
    const auto covariance = poseCovariance(at_rest, kPose);
    ASSERT_TRUE(covariance);
    predicted += *covariance / kTrials;
  }
  const double tolerance = 5 * std::sqrt(2.0 / kTrials);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double scale = std::sqrt(predicted(i, i) * predicted(j, j));
      EXPECT_NEAR(sample(i, j) / scale, predicted(i, j) / scale, tolerance)
          << i << ", " << j;
    }
}
