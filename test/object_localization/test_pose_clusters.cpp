// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/pose.h>
#include <pcl6d/object_localization/pose_clusters.h>

#include <gtest/gtest.h>

namespace pcl6d {
namespace {
const Eigen::Vector3d kMiddle(0.5, -0.2, 0.1);

/** A pose that holds the middle of the model at a place, turned by yaw. */
VotedPose
voted(const Eigen::Vector3d& place, double yaw, double votes)
{
  VotedPose pose;
  pose.T_scene_model.linear() = rotationFromEuler({0, 0, yaw});
  pose.T_scene_model.translation() = place - pose.T_scene_model.linear() * kMiddle;
  pose.votes = votes;
  return pose;
}
} // namespace

TEST(ClusterPoses, GivesTheMeanWeightedByVotes)
{
  const auto groups = clusterPoses({voted({1, 0, 0}, 0.10, 10),
                                    voted({5, 0, 0}, 0.1, 15),
                                    voted({1.04, 0, 0}, 0.18, 30)},
                                   kMiddle,
                                   0.1,
                                   0.35);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].votes, 40);
  EXPECT_EQ(groups[1].votes, 15);
  EXPECT_LT((groups[0].T_scene_model * kMiddle - Eigen::Vector3d(1.03, 0, 0)).norm(),
            1e-12);
  EXPECT_NEAR(eulerFromRotation(groups[0].T_scene_model.linear()).yaw, 0.16, 1e-4);
  EXPECT_TRUE(isRigid(groups[0].T_scene_model, 1e-12));
}

TEST(ClusterPoses, CountsDistancesAtTheMiddle)
{
  // Turned by 0.3 about its middle, the model's origin moves by 0.16 m.
  const auto near = clusterPoses(
      {voted({1, 2, 3}, 0, 2), voted({1, 2, 3}, 0.3, 1)}, kMiddle, 0.01, 0.35);
  EXPECT_EQ(near.size(), 1u);
  const auto far = clusterPoses(
      {voted({1, 2, 3}, 0, 2), voted({1.011, 2, 3}, 0, 1)}, kMiddle, 0.01, 0.35);
  EXPECT_EQ(far.size(), 2u);
  const auto turned = clusterPoses(
      {voted({1, 2, 3}, 0, 2), voted({1, 2, 3}, 0.36, 1)}, kMiddle, 1, 0.35);
  EXPECT_EQ(turned.size(), 2u);
}

TEST(ClusterPoses, JoinsAcrossHalfATurn)
{
  // Their quaternions have opposite signs.
  const auto groups =
      clusterPoses({voted({0, 0, 1}, M_PI - 0.1, 1), voted({0, 0, 1}, -M_PI + 0.1, 1)},
                   kMiddle,
                   0.1,
                   0.35);
  ASSERT_EQ(groups.size(), 1u);
  const Eigen::Matrix3d half_turn = rotationFromEuler({0, 0, M_PI});
  EXPECT_LT(rotationAngle(half_turn.transpose() * groups[0].T_scene_model.linear()),
            1e-7);
}

TEST(ClusterPoses, GivesNothingForNothing)
{
  EXPECT_TRUE(clusterPoses({}, kMiddle, 0.1, 0.3).empty());
}

} // namespace pcl6d
