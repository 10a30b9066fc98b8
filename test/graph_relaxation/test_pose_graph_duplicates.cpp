// SPDX-License-Identifier: BSD-3-Clause
// Several links between two poses, and links in a file whose poses have another order.
#include "graph_cases.h"

#include <pcl6d/common/error.h>
#include <pcl6d/graph_relaxation/link_error.h>
#include <pcl6d/graph_relaxation/merge_links.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>

#include <gtest/gtest.h>

using pcl6d::Matrix6;
using pcl6d::PoseGraph;
using pcl6d::PoseGraphOptimizer;
using pcl6d::PoseGraphOptions;
using pcl6d::RobustKernel;
using pcl6d::test::largestDifference;
using pcl6d::test::ringGraph;

namespace {
/** \return the graph with every other link given again, turned round */
PoseGraph
withReversedLinks(PoseGraph graph)
{
  const auto links = graph.links;
  for (std::size_t k = 0; k < links.size(); k += 2)
    graph.links.push_back(reversed(links[k]));
  return graph;
}

PoseGraph
withDoubledInformation(PoseGraph graph)
{
  for (std::size_t k = 0; k < graph.links.size(); k += 2)
    graph.links[k].information *= 2;
  return graph;
}
} // namespace

TEST(DuplicateLinks, AreOneLinkToARobustKernel)
{
  const PoseGraph single = ringGraph(20, 0.3, 8);
  for (const RobustKernel kernel : {RobustKernel::kNone,
                                    RobustKernel::kHuber,
                                    RobustKernel::kCauchy,
                                    RobustKernel::kGemanMcClure}) {
    SCOPED_TRACE(toString(kernel));
    PoseGraphOptions options;
    options.robust = kernel;
    const auto twice =
        PoseGraphOptimizer(withReversedLinks(single), options).optimize();
    const auto once =
        PoseGraphOptimizer(withDoubledInformation(single), options).optimize();
    EXPECT_EQ(twice.status, once.status);
    EXPECT_LT(largestDifference(twice.poses, once.poses), 1e-6);
    ASSERT_EQ(twice.weights.size(), withReversedLinks(single).links.size());
    for (std::size_t k = 0; k < single.links.size(); ++k)
      EXPECT_NEAR(twice.weights[k], once.weights[k], 1e-5) << "link " << k;
    for (std::size_t k = single.links.size(); k < twice.weights.size(); ++k)
      EXPECT_EQ(twice.weights[k], twice.weights[2 * (k - single.links.size())]);
  }
}

TEST(DuplicateLinks, CountInChi2AsTheyWereGiven)
{
  PoseGraph graph = ringGraph(10, 0.01, 9);
  auto other = graph.links[3];
  other.T_from_to.translation().x() += 0.1; // contradicts the link
  graph.links.push_back(other);
  PoseGraphOptimizer optimizer(graph);
  const auto result = optimizer.optimize();
  EXPECT_NEAR(result.chi2_before, chi2Of(graph), 1e-9 * result.chi2_before);
  graph.poses = result.poses;
  EXPECT_NEAR(result.chi2_after, chi2Of(graph), 1e-9 * result.chi2_after);
  EXPECT_EQ(result.components[0].num_links, graph.links.size());
}

TEST(DuplicateLinks, ToThePoseItselfAreRefused)
{
  PoseGraph graph = ringGraph(10, 0.01, 9);
  graph.links[3].to = graph.links[3].from;
  EXPECT_THROW(PoseGraphOptimizer{graph}, pcl6d::BadArgument);
}

TEST(TrustedChain, GoesByTheIdsOfThePoses)
{
  // The file has vertices 2, 0, 1, a chain 0 - 1 - 2 and a wrong link from 0 to 2.
  PoseGraph graph;
  graph.poses.assign(3, Eigen::Isometry3d::Identity());
  graph.ids = {2, 0, 1};
  graph.poses[0].translation().x() = 2;
  graph.poses[2].translation().x() = 1;
  const auto ahead = [](double x) {
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.translation().x() = x;
    return motion;
  };
  graph.links = {{1, 2, ahead(1), Matrix6::Identity()},
                 {2, 0, ahead(1), Matrix6::Identity()},
                 {1, 0, ahead(9), Matrix6::Identity()}};
  PoseGraphOptions options;
  options.graduated = true;
  options.trust_chain = true;
  const auto result = PoseGraphOptimizer(graph, options).optimize();
  EXPECT_EQ(result.weights[0], 1);
  EXPECT_EQ(result.weights[1], 1);
  EXPECT_LT(result.weights[2], 0.5);
}
