// SPDX-License-Identifier: BSD-3-Clause
// Poses of all sweeps from the corrected ones of keyframes.
#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/odometry/keyframe_poses.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {
using pcl6d::BadArgument;
using pcl6d::distanceBetween;
using pcl6d::posesByKeyframes;
using Poses = std::vector<Eigen::Isometry3d>;

Eigen::Isometry3d
poseOf(double x, double y, double yaw)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(x, y, 0.1 * x);
  pose.linear() << std::cos(yaw), -std::sin(yaw), 0, std::sin(yaw), std::cos(yaw), 0, 0,
      0, 1;
  return pose;
}

// A bend of 21 sweeps.
Poses
bend()
{
  Poses poses;
  for (int i = 0; i <= 20; ++i)
    poses.push_back(poseOf(i, 0.05 * i * i, 0.1 * i));
  return poses;
}

double
apart(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  const auto distance = distanceBetween(a, b);
  return distance.translation + distance.rotation;
}
} // namespace

TEST(KeyframePoses, KeyframesHaveTheirCorrectedPoses)
{
  const Poses tracked = bend();
  const Poses corrected = {poseOf(3, 1, 0.4), poseOf(9, 2, 1), poseOf(12, 7, 1.4)};
  const Poses found = posesByKeyframes(tracked, {2, 9, 15}, corrected);
  ASSERT_EQ(found.size(), tracked.size());
  EXPECT_LT(apart(found[2], corrected[0]), 1e-12);
  EXPECT_LT(apart(found[9], corrected[1]), 1e-12);
  EXPECT_LT(apart(found[15], corrected[2]), 1e-12);
}

// A motion of the whole world moves all sweeps alike.
TEST(KeyframePoses, FollowAnotherWorldExactly)
{
  const Poses tracked = bend();
  const Eigen::Isometry3d world = poseOf(-40, 12, 2.5);
  const std::vector<std::size_t> keyframes = {1, 7, 18};
  Poses corrected;
  for (const std::size_t key : keyframes)
    corrected.push_back(world * tracked[key]);
  const Poses found = posesByKeyframes(tracked, keyframes, corrected);
  for (std::size_t i = 0; i < tracked.size(); ++i)
    EXPECT_LT(apart(found[i], world * tracked[i]), 1e-9) << i;
}

TEST(KeyframePoses, SweepsOutsideKeepTheirMotionRelativeToTheNearestKeyframe)
{
  const Poses tracked = bend();
  const Poses corrected = {poseOf(3, 1, 0.4), poseOf(9, 2, 1)};
  const Poses found = posesByKeyframes(tracked, {5, 10}, corrected);
  EXPECT_LT(apart(corrected[0].inverse() * found[0], tracked[5].inverse() * tracked[0]),
            1e-9);
  EXPECT_LT(
      apart(corrected[1].inverse() * found[20], tracked[10].inverse() * tracked[20]),
      1e-9);
}

// A straight drive whose second keyframe is pushed aside: the sweeps between follow linearly.
TEST(KeyframePoses, TheCorrectionGrowsFromOneKeyframeToTheNext)
{
  Poses tracked;
  for (int i = 0; i <= 4; ++i)
    tracked.push_back(poseOf(i, 0, 0));
  const Poses found =
      posesByKeyframes(tracked, {0, 4}, {poseOf(0, 0, 0), poseOf(4, 0.4, 0)});
  for (int i = 0; i <= 4; ++i)
    EXPECT_NEAR(found[static_cast<std::size_t>(i)].translation().y(), 0.1 * i, 1e-12);
}

TEST(KeyframePoses, RefuseKeyframesThatAreNone)
{
  const Poses tracked = bend();
  const Poses one = {poseOf(0, 0, 0)}, two = {one[0], one[0]};
  EXPECT_THROW(posesByKeyframes(tracked, {}, {}), BadArgument);
  EXPECT_THROW(posesByKeyframes(tracked, {1, 2}, one), BadArgument);
  EXPECT_THROW(posesByKeyframes(tracked, {21}, one), BadArgument);
  EXPECT_THROW(posesByKeyframes(tracked, {3, 3}, two), BadArgument);
  EXPECT_THROW(posesByKeyframes(tracked, {4, 3}, two), BadArgument);
}

TEST(KeyframesAlong, FollowAfterTheWayOrTheTurn)
{
  using pcl6d::keyframesAlong;
  Poses straight;
  for (int i = 0; i <= 20; ++i) {
    straight.push_back(Eigen::Isometry3d::Identity());
    straight.back().translation().x() = 0.5 * i;
  }
  EXPECT_EQ(keyframesAlong(straight, 2, 1),
            (std::vector<std::size_t>{0, 4, 8, 12, 16, 20}));
  EXPECT_EQ(keyframesAlong(straight, 3.9, 1), (std::vector<std::size_t>{0, 8, 16, 20}));
  Poses turning;
  for (int i = 0; i <= 10; ++i)
    turning.push_back(poseOf(0, 0, 0.1 * i));
  EXPECT_EQ(keyframesAlong(turning, 1, 0.25),
            (std::vector<std::size_t>{0, 3, 6, 9, 10}));
  EXPECT_EQ(keyframesAlong({turning[0]}, 1, 1), (std::vector<std::size_t>{0}));
  EXPECT_THROW(keyframesAlong({}, 1, 1), BadArgument);
  EXPECT_THROW(keyframesAlong(turning, 0, 1), BadArgument);
  EXPECT_THROW(keyframesAlong(turning, 1, -1), BadArgument);
}
