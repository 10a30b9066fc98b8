// SPDX-License-Identifier: BSD-3-Clause
// Graphs and options at the edge of what can be solved, and beyond.
#include "graph_cases.h"
#include "optimized.h"
#include "support/bits.h"

#include <pcl6d/common/error.h>
#include <pcl6d/graph_relaxation/link_error.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>

#include <gtest/gtest.h>

using pcl6d::GraphMethod;
using pcl6d::Matrix6;
using pcl6d::PoseGraph;
using pcl6d::PoseGraphOptimizer;
using pcl6d::PoseGraphOptions;
using pcl6d::PoseGraphResult;
using pcl6d::Status;
using pcl6d::test::optimized;
using pcl6d::test::ringGraph;
using pcl6d::test::startFromChain;

namespace {

/** Pose 1 was measured 1 m ahead of pose 0, with this information. */
PoseGraph
twoPoses(const Matrix6& information, const Eigen::Vector3d& start)
{
  PoseGraph graph;
  graph.poses.assign(2, Eigen::Isometry3d::Identity());
  graph.poses[1].translation() = start;
  Eigen::Isometry3d ahead = Eigen::Isometry3d::Identity();
  ahead.translation().x() = 1;
  graph.links.push_back({0, 1, ahead, information});
  return graph;
}
} // namespace

TEST(PoseGraphOptimizer, ReportsMotionsThatTheLinksLeaveFree)
{
  PoseGraph graph = ringGraph(10, 0.1, 9);
  for (auto& link : graph.links)
    if (link.from == 4 || link.to == 4) { // no link sees where pose 4 is along world z
      link.information.setZero();
      link.information.topLeftCorner<2, 2>().setIdentity();
    }
  for (const GraphMethod method :
       {GraphMethod::kGaussNewton, GraphMethod::kLevenbergMarquardt}) {
    PoseGraphOptions options;
    options.method = method;
    PoseGraphOptimizer optimizer(graph, options);
    const auto& result = optimizer.optimize();
    EXPECT_EQ(result.status, Status::kRankDeficient);
    EXPECT_LT(result.chi2_after, result.chi2_before);
    for (const auto& pose : result.poses)
      EXPECT_TRUE(pcl6d::isRigid(pose, 1e-12));
    EXPECT_THROW(optimizer.marginalCovariances(), pcl6d::ComputeFailed);
  }
}

TEST(PoseGraphOptimizer, LinksWithoutInformationJoinNothing)
{
  PoseGraph graph = ringGraph(10, 0.1, 10);
  for (auto& link : graph.links)
    link.information.setZero();
  const auto result = optimized(graph);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_EQ(result.components.size(), 10u);
  EXPECT_EQ(result.chi2_after, 0);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_TRUE(pcl6d::test::sameBits(result.poses[i], graph.poses[i]));
}

TEST(PoseGraphOptimizer, TakesGraphsWithoutLinksOrPoses)
{
  EXPECT_EQ(optimized(PoseGraph()).status, Status::kOk);
  EXPECT_TRUE(optimized(PoseGraph()).poses.empty());
  PoseGraph single;
  single.poses.assign(1, Eigen::Isometry3d::Identity());
  const auto result = optimized(single);
  EXPECT_EQ(result.status, Status::kOk);
  EXPECT_EQ(result.iterations, 0);
  EXPECT_EQ(result.components.size(), 1u);
}

TEST(PoseGraphOptimizer, KeepsTheInputWhereErrorsOverflow)
{
  PoseGraph graph = ringGraph(10, 0.1, 11);
  graph.links[3].T_from_to.translation().setConstant(1e5);
  graph.links[3].information *= 1e300; // its square overflows
  const auto result = optimized(graph);
  EXPECT_EQ(result.status, Status::kDiverged);
  for (std::size_t i = 0; i < graph.poses.size(); ++i)
    EXPECT_TRUE(pcl6d::test::sameBits(result.poses[i], graph.poses[i]));
}

TEST(PoseGraphOptimizer, StopsAtTheLimitOfIterations)
{
  PoseGraph graph = ringGraph(30, 0.3, 12);
  startFromChain(graph);
  PoseGraphOptions options;
  options.max_iterations = 1;
  PoseGraphOptimizer optimizer(graph, options);
  EXPECT_EQ(optimizer.optimize().status, Status::kMaxIterations);
  EXPECT_EQ(optimizer.result().iterations, 1);
  const double chi2 = optimizer.result().chi2_after;
  EXPECT_NEAR(optimizer.optimize().chi2_before, chi2, 1e-9 * chi2) << "it goes on";
}

TEST(PoseGraphOptimizer, RefusesOptionsThatBreakTheirRules)
{
  const auto messageOf = [](const auto& change) -> std::string {
    PoseGraphOptions options;
    change(options);
    try {
      PoseGraphOptimizer(PoseGraph(), options);
    } catch (const pcl6d::BadArgument& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(messageOf([](auto& o) { o.max_iterations = 0; }),
            "max_iterations = 0, but must be > 0");
  EXPECT_EQ(messageOf([](auto& o) { o.robust_width = 0; }),
            "robust_width = 0, but must be > 0");
  EXPECT_EQ(messageOf([](auto& o) { o.chi2_epsilon = 1; }),
            "chi2_epsilon = 1, but must be >= 0 and < 1");
  EXPECT_EQ(pcl6d::graphMethodFromName("levenberg-marquardt"),
            GraphMethod::kLevenbergMarquardt);
  EXPECT_THROW(pcl6d::graphMethodFromName("newton"), pcl6d::BadArgument);
}

TEST(PoseGraphOptimizer, RefusesInformationThatIsIndefinite)
{
  Matrix6 information = Matrix6::Identity();
  information(0, 1) = information(1, 0) = 5;
  EXPECT_THROW(optimized(twoPoses(information, {2, -1, 0})), pcl6d::BadArgument);
}

TEST(PoseGraphOptimizer, NeverFallsBelowZero)
{
  Matrix6 information = Matrix6::Identity();
  information(0, 1) = information(1, 0) = 1 + 1e-7; // digits that a file has lost
  const auto result = optimized(twoPoses(information, {2, -1, 0}));
  EXPECT_GT(result.chi2_before, -1e-14);
  EXPECT_GT(result.chi2_after, -1e-14);
}

TEST(PoseGraphOptimizer, SaysTheLimitBeforeWhatIsFree)
{
  PoseGraph graph = ringGraph(30, 0.3, 12);
  startFromChain(graph);
  for (auto& link : graph.links)
    if (link.from == 4 || link.to == 4) {
      link.information.setZero();
      link.information.topLeftCorner<2, 2>().setIdentity();
    }
  PoseGraphOptions options;
  options.max_iterations = 1;
  EXPECT_EQ(optimized(graph, options).status, Status::kMaxIterations);
}

TEST(PoseGraphOptimizer, IsNotDoneWhereNoStepKeepsItsPromise)
{
  // The square of the distance is finite, but not of anything beyond.
  PoseGraph graph = twoPoses(1e8 * Matrix6::Identity(), {0, 0, 0});
  graph.links[0].T_from_to.translation().x() = 1e150;
  const auto result = optimized(graph);
  EXPECT_TRUE(result.poses[1].matrix().allFinite());
  if (result.chi2_after > 1e-6 * result.chi2_before) {
    EXPECT_NE(result.status, Status::kOk);
  }
}
