// SPDX-License-Identifier: BSD-3-Clause
#include "graph_cases.h"
#include "optimized.h"
#include "support/bits.h"

#include <pcl6d/graph_relaxation/link_error.h>
#include <pcl6d/graph_relaxation/merge_links.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>

#include <gtest/gtest.h>

using pcl6d::GraphMethod;
using pcl6d::Matrix6;
using pcl6d::PoseGraph;
using pcl6d::PoseGraphOptimizer;
using pcl6d::PoseGraphOptions;
using pcl6d::PoseGraphResult;
using pcl6d::Status;
using pcl6d::test::largestDifference;
using pcl6d::test::optimized;
using pcl6d::test::ringGraph;
using pcl6d::test::startFromChain;
using pcl6d::test::twoRings;

namespace {

class Methods : public testing::TestWithParam<GraphMethod> {};
} // namespace

TEST_P(Methods, FindTheTruthOfExactMeasurements)
{
  PoseGraph graph = ringGraph(40, 0, 3);
  const auto truth = graph.poses;
  pcl6d::Random random(4);
  for (std::size_t i = 1; i < graph.poses.size(); ++i)
    graph.poses[i] = pcl6d::test::disturbed(truth[i], random, 0.3);
  PoseGraphOptions options;
  options.method = GetParam();
  const auto result = optimized(graph, options);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_LT(largestDifference(result.poses, truth), 1e-7); // chi2 stops at rounding
  EXPECT_LT(result.chi2_after, 1e-12);
  EXPECT_NEAR(result.chi2_before, chi2Of(graph), 1e-9 * result.chi2_before);
}

TEST_P(Methods, EndWhereNoSmallMotionLowersTheCost)
{
  PoseGraph graph = ringGraph(30, 0.1, 5);
  startFromChain(graph);
  PoseGraphOptions options;
  options.method = GetParam();
  options.chi2_epsilon = 1e-13;
  const auto result = optimized(graph, options);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_LT(result.chi2_after, result.chi2_before);
  EXPECT_TRUE(pcl6d::test::sameBits(result.poses[0], graph.poses[0])) << "it is fixed";
  graph.poses = result.poses;
  EXPECT_NEAR(result.chi2_after, chi2Of(graph), 1e-10 * result.chi2_after);
  for (std::size_t i = 1; i < graph.poses.size(); ++i) {
    pcl6d::Random random(i);
    graph.poses[i] = pcl6d::test::disturbed(result.poses[i], random, 1e-3);
    EXPECT_GT(chi2Of(graph), result.chi2_after) << "pose " << i;
    graph.poses[i] = result.poses[i];
  }
}

INSTANTIATE_TEST_SUITE_P(PoseGraphOptimizer,
                         Methods,
                         testing::Values(GraphMethod::kGaussNewton,
                                         GraphMethod::kLevenbergMarquardt),
                         [](const auto& method) {
                           return method.param == GraphMethod::kGaussNewton
                                      ? "GaussNewton"
                                      : "LevenbergMarquardt";
                         });

TEST(PoseGraphOptimizer, DoesNotDependOnTheFrame)
{
  PoseGraph graph = ringGraph(20, 0.1, 6);
  const auto result = optimized(graph);
  pcl6d::Random random(1);
  const auto motion = pcl6d::test::randomPose(random, 100, 2);
  for (auto& pose : graph.poses)
    pose = motion * pose;
  auto moved = optimized(graph).poses;
  for (auto& pose : moved)
    pose = motion.inverse() * pose;
  EXPECT_LT(largestDifference(result.poses, moved), 1e-9);
}

TEST(PoseGraphOptimizer, GivesTheSameBitsForAnyNumberOfThreads)
{
  PoseGraph graph = ringGraph(700, 0.02, 7);
  startFromChain(graph);
  PoseGraphOptions options;
  options.num_threads = 1;
  const auto expected = optimized(graph, options);
  EXPECT_EQ(expected.status, Status::kOk);
  for (const unsigned int threads : {2u, 5u}) {
    options.num_threads = threads;
    const auto result = optimized(graph, options);
    EXPECT_EQ(result.chi2_after, expected.chi2_after);
    for (std::size_t i = 0; i < graph.poses.size(); ++i)
      EXPECT_TRUE(pcl6d::test::sameBits(result.poses[i], expected.poses[i]));
  }
}

TEST(PoseGraphOptimizer, SolvesComponentsByThemselves)
{
  const PoseGraph graph = twoRings(0.1);
  const auto result = optimized(graph);
  EXPECT_EQ(result.status, Status::kOk);
  ASSERT_EQ(result.components.size(), 3u);
  EXPECT_EQ(result.components[1].fixed_pose, 10u);
  EXPECT_EQ(result.components[1].num_poses, 12u);
  EXPECT_EQ(result.components[2].num_poses, 1u);
  EXPECT_EQ(result.component[9], 0u);
  EXPECT_EQ(result.component[10], 1u);
  EXPECT_EQ(result.component[22], 2u);
  EXPECT_TRUE(pcl6d::test::sameBits(result.poses[22], graph.poses[22]));
  EXPECT_EQ(result.components[0].num_links + result.components[1].num_links,
            graph.links.size());
  const auto alone = optimized(ringGraph(12, 0.1, 2));
  EXPECT_EQ(result.components[1].chi2_after, alone.chi2_after);
  for (std::size_t i = 0; i < 12; ++i)
    EXPECT_TRUE(pcl6d::test::sameBits(result.poses[10 + i], alone.poses[i]));
}

TEST(PoseGraphOptimizer, TakesSeveralLinksBetweenTwoPoses)
{
  PoseGraph graph = ringGraph(10, 1e-4, 8);
  const auto more = ringGraph(10, 1e-4, 8).links;
  for (std::size_t k = 0; k < more.size(); k += 2) {
    auto link = reversed(more[k]);
    link.T_from_to.translation().x() += 1e-4;
    graph.links.push_back(link);
  }
  const auto result = optimized(graph);
  EXPECT_EQ(result.status, Status::kOk);
  PoseGraph merged = graph;
  merged.links = mergeLinks(graph);
  EXPECT_LT(merged.links.size(), graph.links.size());
  // The square of 1e-4 m, times the arms of the ring.
  EXPECT_LT(largestDifference(optimized(merged).poses, result.poses), 1e-6);
}

TEST(PoseGraphOptimizer, ClosesALoopThatTurnsByPi)
{
  PoseGraph graph;
  for (int i = 0; i <= 4; ++i)
    graph.poses.push_back(
        pcl6d::poseFromEuler({double(i), 0, 0}, {0, 0, i * M_PI / 4}));
  for (std::size_t i = 0; i < 4; ++i)
    graph.links.push_back(
        {i, i + 1, graph.poses[i].inverse() * graph.poses[i + 1], Matrix6::Identity()});
  graph.links.push_back(
      {4, 0, graph.poses[4].inverse() * graph.poses[0], Matrix6::Identity()});
  EXPECT_NEAR(pcl6d::rotationAngle(graph.links[4].T_from_to.linear()), M_PI, 1e-12);
  const auto truth = graph.poses;
  pcl6d::Random random(1);
  for (std::size_t i = 1; i <= 4; ++i)
    graph.poses[i] = pcl6d::test::disturbed(truth[i], random, 0.2);
  const auto result = optimized(graph);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_LT(largestDifference(result.poses, truth), 1e-6);
}

TEST(PoseGraphOptimizer, UndoesAnErrorThatTurnsByPi)
{
  PoseGraph graph;
  graph.poses.assign(2, Eigen::Isometry3d::Identity());
  graph.poses[1] = pcl6d::poseFromEuler({1, 0, 0}, {M_PI, 0, 0});
  graph.links.push_back({0, 1, Eigen::Isometry3d::Identity(), Matrix6::Identity()});
  const auto result = optimized(graph);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_NEAR(result.chi2_before, 5, 1e-12); // 1 m, and twice the quaternion's vector
  EXPECT_LT(result.chi2_after, 1e-12);
  EXPECT_LT(largestDifference(result.poses, {graph.poses[0], graph.poses[0]}), 1e-6);
}
