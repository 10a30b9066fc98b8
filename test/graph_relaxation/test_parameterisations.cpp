// SPDX-License-Identifier: BSD-3-Clause
#include "support/pairs.h"

#include <pcl6d/graph_relaxation/parameterisations.h>

#include <gtest/gtest.h>

#include <unsupported/Eigen/MatrixFunctions>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {
Twist
randomTwist(Random& random, double size)
{
  Twist X;
  X << randomVector(random, size), randomVector(random, size);
  return X;
}

/** The motion of -X about the pose's position, to first order: a point p of the scan moves
 * by -(xb + x x (p - t)). */
Eigen::Vector3d
displaced(const Eigen::Isometry3d& pose, const Twist& X, const Eigen::Vector3d& p)
{
  const Eigen::Vector3d arm = p - pose.translation();
  return p - X.head<3>() - Eigen::Vector3d(X.tail<3>()).cross(arm);
}

using Move = Eigen::Isometry3d (*)(const Eigen::Isometry3d&, const Twist&);
} // namespace

TEST(Moves, AgreeToFirstOrder)
{
  Random random(1);
  constexpr double kSize = 1e-5; // second order: 1e-10 times 10 m
  for (const Move move : {&moveByHelix, &moveByEuler, &moveByQuaternion})
    for (int trial = 0; trial < 50; ++trial) {
      const Eigen::Isometry3d pose = randomPose(random, 100, random.uniform(0, 3));
      const Twist X = randomTwist(random, kSize);
      const Eigen::Vector3d u = randomVector(random, 10);
      const Eigen::Isometry3d moved = move(pose, X);
      EXPECT_TRUE(isRigid(moved, 1e-14));
      EXPECT_LT((moved * u - displaced(pose, X, pose * u)).norm(), 1e-8);
    }
}

TEST(Moves, OfTheHelixAreTheMatrixExponential)
{
  Random random(2);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Isometry3d pose = randomPose(random, 10, 2);
    const Twist X = randomTwist(random, 1);
    Eigen::Matrix4d generator = Eigen::Matrix4d::Zero(); // about the world's origin
    generator.topLeftCorner<3, 3>() = -skew(X.tail<3>());
    generator.topRightCorner<3, 1>() =
        -X.head<3>() + Eigen::Vector3d(X.tail<3>()).cross(pose.translation());
    const Eigen::Matrix4d expected = generator.exp() * pose.matrix();
    EXPECT_LT((moveByHelix(pose, X).matrix() - expected).norm(), 1e-12);
  }
}

TEST(Moves, OfTheQuaternionWithScaleDropTheScale)
{
  Random random(3);
  const Eigen::Isometry3d pose = randomPose(random, 10, 2);
  Eigen::Matrix<double, 7, 1> X = Eigen::Matrix<double, 7, 1>::Zero();
  X(3) = 0.3; // no turn to normalise: nothing moves
  EXPECT_LT((moveByScaledQuaternion(pose, X).matrix() - pose.matrix()).norm(), 1e-14);
}

TEST(Moves, ByEulerStayFiniteInGimbalLock)
{
  for (const double pitch : {M_PI / 2, -M_PI / 2, M_PI / 2 - 1e-9}) {
    const Eigen::Isometry3d pose = poseFromEuler({1, 2, 3}, {0.3, pitch, 0.4});
    const Twist X = Twist::Constant(0.01);
    const MotionSize off = distanceBetween(moveByEuler(pose, X), moveByHelix(pose, X));
    EXPECT_LT(off.translation + off.rotation, 1e-12);
  }
}
