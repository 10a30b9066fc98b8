// SPDX-License-Identifier: BSD-3-Clause
#include "support/poses.h"

#include <pcl6d/common/points.h>
#include <pcl6d/common/pose.h>

#include <pcl/point_types.h>

#include <gtest/gtest.h>

#include <limits>

using pcl6d::Random;

TEST(ExtrapolateOdometry, KeepsTheRelativeMotion)
{
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const auto from = pcl6d::test::randomPose(random, 50, 1.0);
    const auto to = pcl6d::test::randomPose(random, 50, 1.0);
    const auto corrected = pcl6d::test::randomPose(random, 50, 3.0);
    const auto predicted = pcl6d::extrapolateOdometry(corrected, from, to);
    const auto error =
        pcl6d::distanceBetween(corrected.inverse() * predicted, from.inverse() * to);
    EXPECT_LT(error.translation, 1e-12);
    EXPECT_LT(error.rotation, 1e-12);
  }
}

TEST(ExtrapolateOdometry, PlanarMotionStaysInThePlaneOfASlopingRobot)
{
  const auto corrected = pcl6d::poseFromEuler({5, -2, 1}, {0.1, -0.3, 2.0});
  const auto predicted = pcl6d::extrapolateOdometry(
      corrected, pcl6d::planarPose(1, 2, 0.5), pcl6d::planarPose(3, 1, -0.2));
  const Eigen::Isometry3d step = corrected.inverse() * predicted;
  EXPECT_NEAR(step.translation().z(), 0, 1e-14);
  EXPECT_NEAR((step.linear() * Eigen::Vector3d::UnitZ()).z(), 1, 1e-14);
}

TEST(ExactlyRigid, RemovesRoundingErrorsAndKeepsThePosition)
{
  constexpr double kScale = 1e-6;     // also the largest turn [rad] by the scale
  constexpr double kRounding = 4e-15; // of products of unit vectors
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Isometry3d pose = pcl6d::test::randomPose(random, 50, 3.0);
    Eigen::Isometry3d grown = pose;
    grown.linear() *= 1 + kScale;
    const Eigen::Isometry3d exact = pcl6d::exactlyRigid(grown);
    const Eigen::Matrix3d R = exact.linear();
    EXPECT_LT((R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(),
              kRounding);
    EXPECT_EQ(exact.translation(), pose.translation());
    EXPECT_LT(pcl6d::distanceBetween(pose, exact).rotation, kScale);
  }
}

TEST(IsRigid, AcceptsPosesAndRefusesScaleMirrorAndNan)
{
  Random random(2);
  Eigen::Isometry3d pose = pcl6d::test::randomPose(random, 1e6, 2.0);
  EXPECT_TRUE(pcl6d::isRigid(pose));
  Eigen::Isometry3d scaled = pose;
  scaled.linear() *= 1.01;
  EXPECT_FALSE(pcl6d::isRigid(scaled));
  Eigen::Isometry3d mirrored = pose;
  mirrored.linear().col(0) *= -1;
  EXPECT_FALSE(pcl6d::isRigid(mirrored));
  pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(pcl6d::isRigid(pose));
}

TEST(WorldOffset, IsZeroNearTheOriginAndWholeMetresFarAway)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << 9999, 0, 10;
  EXPECT_EQ(pcl6d::worldOffset(pose), Eigen::Vector3d::Zero());
  pose.translation() << 691234.567, 5336789.123, 512.4;
  EXPECT_EQ(pcl6d::worldOffset(pose), Eigen::Vector3d(691235, 5336789, 512));
}

TEST(Points, AreCopiedInOrderAndMovedRigidly)
{
  pcl::PointCloud<pcl::PointXYZ> cloud;
  cloud.push_back({1, 2, 3});
  cloud.push_back({4, 5, 6});
  EXPECT_EQ(pcl6d::toPoints(cloud).size(), 2u);
  const auto chosen = pcl6d::toPoints(cloud, pcl::Indices{1});
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0], Eigen::Vector3f(4, 5, 6));
  const auto moved = pcl6d::transformed(chosen, pcl6d::planarPose(1, 0, M_PI / 2));
  EXPECT_NEAR((moved[0] - Eigen::Vector3f(-4, 4, 6)).norm(), 0, 1e-6);
}
