// SPDX-License-Identifier: BSD-3-Clause
#include "support/poses.h"

#include <pcl6d/common/rotation.h>

#include <pcl/common/transforms.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using pcl6d::EulerAngles;
using pcl6d::Random;

namespace {
constexpr int kRotations = 200;
constexpr double kEntryRounding = 1e-14; // a few ulp of entries of size one

double
difference(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b)
{
  return (a - b).cwiseAbs().maxCoeff();
}
} // namespace

TEST(Euler, BuildsTheMatrixThatPclBuilds)
{
  Random random(1);
  for (int i = 0; i < kRotations; ++i) {
    const EulerAngles a{
        random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4)};
    Eigen::Affine3d expected;
    pcl::getTransformation<double>(0, 0, 0, a.roll, a.pitch, a.yaw, expected);
    EXPECT_LT(difference(pcl6d::rotationFromEuler(a), expected.linear()),
              kEntryRounding);
  }
}

TEST(Euler, ComesBackFromTheMatrix)
{
  Random random(2);
  for (int i = 0; i < kRotations; ++i) {
    const EulerAngles a{random.uniform(-3.1, 3.1),
                        random.uniform(-1.5, 1.5),
                        random.uniform(-3.1, 3.1)};
    const EulerAngles b = pcl6d::eulerFromRotation(pcl6d::rotationFromEuler(a));
    EXPECT_NEAR(a.roll, b.roll, 1e-12);
    EXPECT_NEAR(a.pitch, b.pitch, 1e-12);
    EXPECT_NEAR(a.yaw, b.yaw, 1e-12);
  }
}

TEST(Euler, GivesTheSameRotationInGimbalLock)
{
  for (const double pitch : {M_PI / 2, -M_PI / 2})
    for (const double roll : {0.0, 0.4, -2.0}) {
      const auto R = pcl6d::rotationFromEuler({roll, pitch, 0.7});
      const EulerAngles a = pcl6d::eulerFromRotation(R);
      EXPECT_EQ(a.yaw, 0);
      EXPECT_LT(difference(pcl6d::rotationFromEuler(a), R), 1e-12);
    }
}

TEST(Euler, StaysFiniteForEntriesBeyondOne)
{
  Eigen::Matrix3d R = pcl6d::rotationFromEuler({0, M_PI / 2, 0});
  R(2, 0) = -1 - 1e-7; // pcl::getTranslationAndEulerAngles gives NaN here
  EXPECT_NEAR(pcl6d::eulerFromRotation(R).pitch, M_PI / 2, 1e-6);
}

TEST(Euler, PositivePitchTurnsTheForwardAxisDown)
{
  const Eigen::Vector3d forward =
      pcl6d::rotationFromEuler({0, 0.1, 0}) * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(forward.z(), -std::sin(0.1), kEntryRounding);
}

TEST(RotationVector, IsTheInverseOfTheExponentialAtAllAngles)
{
  Random random(3);
  for (const double angle : {0.0, 1e-12, 1e-9, 1e-8, 1e-5, 0.3, 3.0, M_PI - 1e-7}) {
    SCOPED_TRACE("angle [rad] " + std::to_string(angle));
    const Eigen::Vector3d w =
        angle * Eigen::Vector3d(random.normal(), random.normal(), 1).normalized();
    const Eigen::Matrix3d R = pcl6d::rotationFromVector(w);
    EXPECT_LT(
        difference(R, Eigen::AngleAxisd(angle, w.normalized()).toRotationMatrix()),
        angle > 0 ? kEntryRounding : 1); // the axis of a zero vector is undefined
    EXPECT_LT((pcl6d::rotationVector(R) - w).norm(), 1e-14 + 1e-14 * angle);
  }
}

TEST(RotationVector, HalfATurnGivesTheAxisUpToSign)
{
  Random random(4);
  for (int i = 0; i < kRotations; ++i) {
    const Eigen::Matrix3d R = pcl6d::test::randomRotation(random, M_PI);
    const Eigen::Vector3d w = pcl6d::rotationVector(R);
    EXPECT_NEAR(w.norm(), M_PI, 1e-12);
    EXPECT_LT(difference(pcl6d::rotationFromVector(w), R), 1e-12);
  }
}

TEST(Slerp, MeetsBothEndsAndHalvesTheAngle)
{
  Random random(5);
  for (int i = 0; i < kRotations; ++i) {
    const auto R0 = pcl6d::test::randomRotation(random, 2.0);
    const double angle = random.uniform(0, 3.1);
    const Eigen::Matrix3d R1 = pcl6d::test::randomRotation(random, angle) * R0;
    EXPECT_LT(difference(pcl6d::slerp(R0, R1, 0), R0), 1e-13);
    EXPECT_LT(difference(pcl6d::slerp(R0, R1, 1), R1), 1e-13);
    const Eigen::Matrix3d half = pcl6d::slerp(R0, R1, 0.5);
    EXPECT_NEAR(pcl6d::rotationAngle(half * R0.transpose()), angle / 2, 1e-12);
    const Eigen::Matrix3d eigen =
        Eigen::Quaterniond(R0).slerp(0.5, Eigen::Quaterniond(R1)).toRotationMatrix();
    EXPECT_LT(difference(half, eigen), 1e-12);
  }
}

TEST(NearestRotation, LeavesRotationsAndRepairsTheRest)
{
  Random random(6);
  for (int i = 0; i < kRotations; ++i) {
    const auto R = pcl6d::test::randomRotation(random, 2.0);
    EXPECT_LT(difference(pcl6d::nearestRotation(R), R), 1e-13);
    EXPECT_LT(difference(pcl6d::nearestRotation(1.7 * R), R), 1e-13);
    EXPECT_NEAR(pcl6d::nearestRotation(-R).determinant(), 1, 1e-13);
  }
}

TEST(ShortestRotation, TurnsOneDirectionIntoAnotherByTheAngleBetweenThem)
{
  Random random(7);
  for (const double angle : {0.0, 1e-9, 0.3, 2.0, M_PI - 1e-4, M_PI - 1e-7, M_PI}) {
    SCOPED_TRACE("angle [rad] " + std::to_string(angle));
    const auto R = pcl6d::test::randomRotation(random, 2.0);
    const Eigen::Vector3d from = R.col(0);
    const Eigen::Vector3d to = std::cos(angle) * R.col(0) + std::sin(angle) * R.col(1);
    const Eigen::Quaterniond q = pcl6d::shortestRotation(0.1 * from, 7 * to);
    // Opposite is what lies within 1.4e-6 rad of it, where a cosine shows no more.
    const double tolerance = angle > 3 ? 1.4e-6 : kEntryRounding;
    EXPECT_LT((q * from - to).norm(), tolerance);
    EXPECT_NEAR(pcl6d::rotationAngle(q.toRotationMatrix()), angle, 1.4e-6);
  }
}

TEST(WrapAngle, LandsInTheHalfOpenInterval)
{
  EXPECT_NEAR(pcl6d::wrapAngle(3 * M_PI), M_PI, 1e-12);
  EXPECT_EQ(pcl6d::wrapAngle(-M_PI), M_PI);
  EXPECT_EQ(pcl6d::wrapAngle(M_PI), M_PI);
  EXPECT_NEAR(pcl6d::wrapAngle(2 * M_PI + 0.1), 0.1, 1e-12);
}

TEST(CanonicalQuaternion, IsTheSameRotationWithPositiveW)
{
  const Eigen::Quaterniond q(-0.5, 0.5, 0.5, 0.5);
  EXPECT_GT(pcl6d::canonical(q).w(), 0);
  EXPECT_LT(difference(pcl6d::canonical(q).toRotationMatrix(), q.toRotationMatrix()),
            kEntryRounding);
}
