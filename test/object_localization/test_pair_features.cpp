// SPDX-License-Identifier: BSD-3-Clause
#include "object_localization/localization_cases.h"
#include "support/bits.h"
#include "support/poses.h"

#include <pcl6d/common/error.h>
#include <pcl6d/object_localization/pair_features.h>
#include <pcl6d/object_localization/pose_votes.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace pcl6d {
namespace {
constexpr double kDiameter = 0.44; // [m] of the machine's box
constexpr double kVoxel = 0.05 * kDiameter;

OrientedPoints
machine()
{
  return reduceOriented(test::machineSurface(0.005), kVoxel);
}
} // namespace

TEST(FrameOf, HoldsThePointAndItsNormal)
{
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Isometry3d pose = test::randomPose(random, 2, random.uniform(0, 3));
    const Eigen::Vector3f point = pose.translation().cast<float>();
    const Eigen::Vector3f normal = pose.linear().col(0).cast<float>();
    const Eigen::Isometry3f frame = frameOf(point, normal);
    EXPECT_LT((frame * point).norm(), 1e-6F);
    EXPECT_LT((frame.linear() * normal - Eigen::Vector3f::UnitX()).norm(), 1e-6F);
    EXPECT_TRUE(isRigid(frame.cast<double>(), 1e-6));
  }
}

TEST(PairFeatureTable, FeaturesStayWhenTheModelMoves)
{
  const OrientedPoints model = machine();
  const PairFeatureTable table(model, kDiameter);
  Random random(2);
  int same = 0, all = 0;
  for (int motion = 0; motion < 5; ++motion) {
    const OrientedPoints there =
        test::moved(model, test::randomPose(random, 2, random.uniform(0, 3)));
    for (std::size_t i = 0; i < model.size(); i += 7)
      for (std::size_t j = 0; j < model.size(); j += 5) {
        same +=
            table.featureOf(
                model.points[i], model.normals[i], model.points[j], model.normals[j]) ==
            table.featureOf(
                there.points[i], there.normals[i], there.points[j], there.normals[j]);
        ++all;
      }
  }
  // Right angles lie at the border of no step: 15 of them make a half turn.
  EXPECT_GT(same, 0.98 * all);
}

TEST(PairFeatureTable, FindsEachPairByItsFeature)
{
  const OrientedPoints model = machine();
  const PairFeatureTable table(model, kDiameter);
  ASSERT_EQ(table.numPoints(), model.size());
  for (std::size_t i = 0; i < model.size(); i += 9)
    for (std::size_t j = 0; j < model.size(); j += 11) {
      const int feature = table.featureOf(
          model.points[i], model.normals[i], model.points[j], model.normals[j]);
      if (feature < 0)
        continue;
      const auto pairs = table.pairsWith(feature);
      EXPECT_TRUE(std::any_of(pairs.begin(),
                              pairs.end(),
                              [&](const auto& pair) { return pair.first == i; }))
          << i << " " << j;
    }
}

TEST(PairFeatureTable, LeavesOutFlatPairsUnlessTheModelIsASheet)
{
  const auto flat = [](const PairFeatureTable& table) {
    return table.featureOf({0, 0, 0}, {0, 0, 1}, {0.1F, 0, 0}, {0, 0, 1});
  };
  EXPECT_EQ(flat(PairFeatureTable(machine(), kDiameter)), -1);
  OrientedPoints sheet;
  test::addPatch(sheet, {{0, 0, 0}, {0.3, 0, 0}, {0, 0.3, 0}}, 0.02);
  EXPECT_GE(flat(PairFeatureTable(sheet, kDiameter)), 0);
}

TEST(VoteForPoses, FindsAMovedModel)
{
  const PairFeatureTable table(machine(), kDiameter);
  Random random(3);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Isometry3d truth = test::randomPose(random, 1, random.uniform(0, 3));
    const OrientedPoints scene =
        reduceOriented(test::moved(test::machineSurface(0.005), truth), kVoxel);
    const auto poses = voteForPoses(table, scene, PointTree(scene.points));
    ASSERT_FALSE(poses.empty());
    const auto best =
        std::max_element(poses.begin(), poses.end(), [](const auto& a, const auto& b) {
          return a.votes < b.votes;
        });
    const MotionSize off = distanceBetween(truth, best->T_scene_model);
    EXPECT_LT(off.translation, 2 * kVoxel);
    EXPECT_LT(off.rotation, 2 * M_PI / 30);
  }
}

TEST(VoteForPoses, GivesTheSameBitsForAnyNumberOfThreads)
{
  const PairFeatureTable table(machine(), kDiameter);
  const OrientedPoints scene = machine();
  const PointTree tree(scene.points);
  PoseVoteOptions options;
  options.num_threads = 1;
  const auto one = voteForPoses(table, scene, tree, options);
  for (const unsigned int threads : {2u, 8u}) {
    options.num_threads = threads;
    const auto several = voteForPoses(table, scene, tree, options);
    ASSERT_EQ(several.size(), one.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_TRUE(test::sameBits(several[i].T_scene_model, one[i].T_scene_model));
      EXPECT_EQ(several[i].votes, one[i].votes);
    }
  }
}

TEST(PairFeatureTable, RefusesBadArguments)
{
  OrientedPoints two;
  two.points = {{0, 0, 0}, {1, 0, 0}};
  two.normals = {{0, 0, 1}, {0, 0, 1}};
  EXPECT_THROW(PairFeatureTable(two, 1), BadArgument);
  EXPECT_THROW(PairFeatureTable(machine(), 0), BadArgument);
  PairFeatureOptions options;
  options.angle_steps = 3;
  EXPECT_THROW(PairFeatureTable(machine(), 1, options), BadArgument);
  options = {};
  options.distance_steps = 61;
  EXPECT_THROW(options.validate(), BadArgument);
  const PairFeatureTable table(machine(), kDiameter);
  PoseVoteOptions voting;
  voting.turn_steps = 7;
  EXPECT_THROW(voteForPoses(table, two, PointTree(two.points), voting), BadArgument);
  voting = {};
  voting.reference_stride = 0;
  EXPECT_THROW(voting.validate(), BadArgument);
  EXPECT_TRUE(voteForPoses(table, {}, PointTree(Points())).empty());
}

} // namespace pcl6d
