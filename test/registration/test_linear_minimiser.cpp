// SPDX-License-Identifier: BSD-3-Clause
#include "rigid_cases.h"
#include "support/fit_oracles.h"
#include "support/pairs.h"

#include <pcl6d/registration/linear_minimiser.h>
#include <pcl6d/registration/twist.h>

#include <gtest/gtest.h>

#include <unsupported/Eigen/MatrixFunctions>

using pcl6d::motionFromTwist;
using pcl6d::Random;
using pcl6d::RigidMinimiser;
using pcl6d::skew;
using pcl6d::Status;
using pcl6d::Twist;
using pcl6d::test::kRigidHalf;
using pcl6d::test::movedPairs;
using pcl6d::test::Pairs;
using pcl6d::test::randomPoints;
using pcl6d::test::randomPose;

namespace {
constexpr std::size_t kFewPairs = 60;
// Central differences of width h: rounding 1e-16 / h and h^2 / 6 of a third derivative
// near 1 balance at h = 1e-5, with 4e-11 in all; times 10.
constexpr double kStep = 1e-5;
constexpr double kDifferenceTol = 4e-10;

Twist
twistOf(Random& random, double angle, double length)
{
  Twist twist;
  twist << pcl6d::test::randomVector(random, length),
      angle * pcl6d::test::randomVector(random, 1).normalized();
  return twist;
}

/** The motion of 4.1.2, by the axis in Plücker coordinates. */
Eigen::Isometry3d
screw(const Twist& twist)
{
  const Eigen::Vector3d xb = twist.head<3>(), x = twist.tail<3>();
  const double n = x.norm(), pitch = x.dot(xb) / (n * n);
  const Eigen::Vector3d g = x / n, foot = g.cross((xb - pitch * x) / n);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(n, g).toRotationMatrix();
  T.translation() = foot - T.linear() * foot + pitch * n * g;
  return T;
}

/** Solves min |Z - M u| about the source's centroid by QR on all rows. */
Twist
denseSolution(const Pairs& pairs)
{
  const auto sums = pairs.sums();
  Eigen::MatrixXd M(3 * pairs.source.size(), 6);
  Eigen::VectorXd Z(M.rows());
  for (std::size_t i = 0; i < pairs.source.size(); ++i) {
    M.block<3, 3>(3 * i, 0).setIdentity();
    M.block<3, 3>(3 * i, 3) = -skew(pairs.source[i] - sums.mean_source);
    Z.segment<3>(3 * i) = pairs.target[i] - pairs.source[i];
  }
  return pcl6d::test::leastSquares(M, Z);
}
} // namespace

TEST(MotionFromTwist, IsTheMatrixExponential)
{
  Random random(1);
  for (const double angle : {1e-12, 1e-9, 1e-4, 0.0999, 0.1, 1.0, 3.0})
    for (int trial = 0; trial < 20; ++trial) {
      const Twist twist = twistOf(random, angle, 5);
      Eigen::Matrix4d generator = Eigen::Matrix4d::Zero();
      generator.topLeftCorner<3, 3>() = skew(twist.tail<3>());
      generator.topRightCorner<3, 1>() = twist.head<3>();
      const Eigen::Matrix4d expected = generator.exp();
      EXPECT_LT((motionFromTwist(twist).matrix() - expected).norm(), 1e-13);
    }
}

TEST(MotionFromTwist, IsTheHelixAboutItsAxis)
{
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Twist twist = twistOf(random, random.uniform(0.1, 3), 5);
    EXPECT_LT((motionFromTwist(twist).matrix() - screw(twist).matrix()).norm(), 1e-12);
  }
}

TEST(MotionFromTwist, IsATranslationWithoutATurn)
{
  Twist twist;
  twist << 1, 2, 3, 0, 0, 0;
  EXPECT_EQ(motionFromTwist(twist).linear(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(motionFromTwist(twist).translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(TwistFromMotion, IsTheInverse)
{
  Random random(4);
  for (const double angle : {0.0, 1e-9, 1e-4, 0.0099, 0.0101, 1.0, 3.0})
    for (int trial = 0; trial < 20; ++trial) {
      const Twist twist = twistOf(random, angle, 5);
      EXPECT_LT((pcl6d::twistFromMotion(motionFromTwist(twist)) - twist).norm(), 1e-12);
    }
}

TEST(EulerRates, AreTheDerivativeOfTheRotation)
{
  Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Vector3d at = pcl6d::test::randomVector(random, 1.5);
    const auto rotation = [](const Eigen::Vector3d& a) {
      return pcl6d::rotationFromEuler({a.x(), a.y(), a.z()});
    };
    const Eigen::Matrix3d J = pcl6d::eulerRates({at.x(), at.y(), at.z()});
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d h = kStep * Eigen::Vector3d::Unit(i);
      const Eigen::Matrix3d turning = (rotation(at + h) - rotation(at - h)) /
                                      (2 * kStep) * rotation(at).transpose();
      EXPECT_LT((skew(J.col(i)) - turning).norm(), kDifferenceTol);
    }
    EXPECT_NEAR(J.determinant(), std::cos(at.y()), 1e-14);
  }
}

TEST(LinearSteps, SolveTheSameNormalEquations)
{
  // For small motions all retractions are the twist itself, up to its square.
  Random random(4);
  const double angle = 1e-5;
  for (const double centre : {0.0, 1e3}) {
    const Pairs pairs = movedPairs(
        randomPoints(random, kFewPairs, kRigidHalf, Eigen::Vector3d::Constant(centre)),
        Eigen::Isometry3d::Identity(),
        random,
        angle * kRigidHalf);
    const Twist expected = denseSolution(pairs);
    const auto sums = pairs.sums();
    for (const RigidMinimiser& step : {RigidMinimiser(pcl6d::stepByHelix),
                                       RigidMinimiser(pcl6d::stepBySmallAngle),
                                       RigidMinimiser(pcl6d::stepByEuler),
                                       RigidMinimiser(pcl6d::stepByQuaternionLinear)}) {
      const auto found = step(sums);
      ASSERT_EQ(found.status, Status::kOk);
      const Eigen::Vector3d turn = pcl6d::rotationVector(found.transform.linear());
      const Eigen::Vector3d shift =
          found.transform * sums.mean_source - sums.mean_source;
      EXPECT_LT((turn - expected.tail<3>()).norm(), angle * angle);
      EXPECT_LT((shift - expected.head<3>()).norm(),
                angle * angle * kRigidHalf + 1e-12);
    }
  }
}

TEST(LinearSteps, AreTheirOwnMotions)
{
  Random random(5);
  const Eigen::Isometry3d truth = randomPose(random, 3, 0.4);
  const Pairs pairs =
      movedPairs(randomPoints(random, kFewPairs, kRigidHalf), truth, random);
  const Twist u = denseSolution(pairs);
  const auto all = pairs.sums();
  const Eigen::Vector3d to = motionFromTwist(u).translation();
  const auto helix = pcl6d::stepByHelix(all).transform;
  EXPECT_LT((helix.linear() - motionFromTwist(u).linear()).norm(), 1e-12);
  EXPECT_LT((helix * all.mean_source - all.mean_source - to).norm(), 1e-12);
  const Eigen::Matrix3d euler = pcl6d::rotationFromEuler({u(3), u(4), u(5)});
  for (const auto& step : {pcl6d::stepBySmallAngle(all), pcl6d::stepByEuler(all)})
    EXPECT_LT((step.transform.linear() - euler).norm(), 1e-12);
  const Eigen::Quaterniond q(1, u(3) / 2, u(4) / 2, u(5) / 2);
  EXPECT_LT((pcl6d::stepByQuaternionLinear(all).transform.linear() -
             q.normalized().toRotationMatrix())
                .norm(),
            1e-12);
  // From 0.4 rad one step is not the minimum.
  EXPECT_GT(pcl6d::distanceBetween(helix, truth).rotation, 1e-3);
}

TEST(LinearMinimisers, ConvergeWhenTheTargetIsLarger)
{
  // Plain steps would be three times too long and run away.
  Random random(6);
  Pairs pairs = movedPairs(randomPoints(random, kFewPairs, kRigidHalf),
                           randomPose(random, 1, 0.5),
                           random,
                           0.05);
  for (auto& m : pairs.target)
    m *= 3;
  const auto best = pcl6d::minimiseBySVD(pairs.sums());
  for (const auto& minimise : {pcl6d::minimiseByHelix,
                               pcl6d::minimiseBySmallAngle,
                               pcl6d::minimiseByEuler,
                               pcl6d::minimiseByQuaternionLinear}) {
    const auto found = minimise(pairs.sums());
    EXPECT_EQ(found.status, Status::kOk);
    const auto error = pcl6d::distanceBetween(best.transform, found.transform);
    EXPECT_LT(error.rotation, 1e-12);
    EXPECT_LT(error.translation, 1e-10);
  }
}

TEST(LinearMinimisers, DoNotTakeAHalfTurnForTheMinimum)
{
  // The gradient is zero at identity, but it is no minimum.
  const Pairs pairs{{{1, 0, 0}, {-1, 0, 0}, {0, 2, 0}, {0, -2, 0}, {0, 0, 1}},
                    {{-1, 0, 0}, {1, 0, 0}, {0, -2, 0}, {0, 2, 0}, {0, 0, 1}}};
  for (const auto& minimise : {pcl6d::minimiseByHelix,
                               pcl6d::minimiseBySmallAngle,
                               pcl6d::minimiseByEuler,
                               pcl6d::minimiseByQuaternionLinear,
                               pcl6d::minimiseByQuaternionUnconstrained})
    EXPECT_EQ(minimise(pairs.sums()).status, Status::kMaxIterations);
}

TEST(LinearMinimisers, GoThroughAPitchOfARightAngle)
{
  Random random(7);
  const auto source = randomPoints(random, kFewPairs, kRigidHalf);
  for (const double pitch : {M_PI / 2, M_PI / 2 - 1e-9, -M_PI / 2, 1.57}) {
    const Eigen::Isometry3d truth = pcl6d::poseFromEuler({1, 2, 3}, {0.3, pitch, -0.4});
    const auto found = pcl6d::minimiseByEuler(movedPairs(source, truth, random).sums());
    EXPECT_EQ(found.status, Status::kOk);
    EXPECT_LT(pcl6d::distanceBetween(truth, found.transform).rotation, 1e-12);
  }
}

TEST(QuaternionUnconstrained, IsOffByTheScaleTimesTheDistanceOfTheCentroid)
{
  // The book's 4.1.3.4: the same problem, 5 cm of noise, at 0 to 300 m from the origin.
  Random random(8);
  const auto points = randomPoints(random, kFewPairs, kRigidHalf);
  const Eigen::Isometry3d truth = randomPose(random, 1, 0.4);
  const Pairs near = movedPairs(points, truth, random, 0.05);
  double last = 0;
  for (const double distance : {0.0, 3.0, 30.0, 300.0}) {
    SCOPED_TRACE("distance [m] " + std::to_string(distance));
    const Eigen::Vector3d away = distance * Eigen::Vector3d(0.6, 0, 0.8);
    Pairs pairs = near;
    for (auto& d : pairs.source)
      d += away;
    const auto sums = pairs.sums();
    const auto best = pcl6d::similarityByQuaternion(sums);
    const auto found = pcl6d::minimiseByQuaternionUnconstrained(sums);
    EXPECT_EQ(found.status, Status::kOk);
    const auto error = pcl6d::distanceBetween(best.rigid.transform, found.transform);
    EXPECT_LT(error.rotation, 1e-12);
    const double bias = std::abs(best.scale - 1) * sums.mean_source.norm();
    EXPECT_NEAR(error.translation, bias, 1e-10);
    EXPECT_TRUE(distance == 0 || error.translation > last) << error.translation;
    last = error.translation;
    // With the scale held there is none.
    const auto held = pcl6d::minimiseByQuaternionLinear(sums);
    EXPECT_LT(pcl6d::distanceBetween(best.rigid.transform, held.transform).translation,
              1e-10);
  }
  EXPECT_GT(last, 0.01) << "300 m times a scale that noise makes a fraction of 1e-3";
}

TEST(QuaternionUnconstrained, IsExactWithoutNoise)
{
  Random random(9);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Isometry3d truth = randomPose(random, 20, 1);
    const auto found = pcl6d::minimiseByQuaternionUnconstrained(
        movedPairs(randomPoints(random, kFewPairs, kRigidHalf), truth, random).sums());
    EXPECT_EQ(found.status, Status::kOk);
    EXPECT_LT(pcl6d::distanceBetween(truth, found.transform).translation, 1e-11);
    EXPECT_LT(pcl6d::distanceBetween(truth, found.transform).rotation, 1e-12);
  }
}
