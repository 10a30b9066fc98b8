// SPDX-License-Identifier: BSD-3-Clause
#include "graph_cases.h"
#include "support/bits.h"

#include <pcl6d/common/error.h>
#include <pcl6d/graph_relaxation/merge_links.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

using pcl6d::GraphMethod;
using pcl6d::Matrix6;
using pcl6d::PoseGraph;
using pcl6d::PoseGraphOptimizer;
using pcl6d::PoseGraphOptions;
using pcl6d::PoseGraphResult;
using pcl6d::Status;
using pcl6d::test::largestDifference;
using pcl6d::test::ringGraph;
using pcl6d::test::startFromChain;

namespace {
PoseGraphResult
optimized(const PoseGraph& graph, const PoseGraphOptions& options = {})
{
  return PoseGraphOptimizer(graph, options).optimize();
}

/** Two rings and a pose alone; the second ring starts at pose 10. */
PoseGraph
twoRings(double noise)
{
  PoseGraph graph = ringGraph(10, noise, 1);
  const PoseGraph second = ringGraph(12, noise, 2);
  graph.poses.insert(graph.poses.end(), second.poses.begin(), second.poses.end());
  for (auto link : second.links) {
    link.from += 10;
    link.to += 10;
    graph.links.push_back(link);
  }
  graph.poses.push_back(second.poses[3]);
  return graph;
}

/** J^T information J over all poses but the first, dense */
Eigen::MatrixXd
denseInformation(const PoseGraph& graph)
{
  const auto size = static_cast<Eigen::Index>(6 * graph.poses.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, size);
  for (const auto& link : graph.links) {
    const auto linear =
        pcl6d::linearizeLink(link, graph.poses[link.from], graph.poses[link.to]);
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6, size);
    J.block<6, 6>(0, 6 * link.from) = linear.J_from;
    J.block<6, 6>(0, 6 * link.to) = linear.J_to;
    H += J.transpose() * link.information * J;
  }
  return H.bottomRightCorner(size - 6, size - 6);
}

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

TEST(PoseGraphOptimizer, StaysFiniteWhereAnErrorTurnsByPi)
{
  PoseGraph graph;
  graph.poses.assign(2, Eigen::Isometry3d::Identity());
  graph.poses[1] = pcl6d::poseFromEuler({1, 0, 0}, {M_PI, 0, 0});
  graph.links.push_back({0, 1, Eigen::Isometry3d::Identity(), Matrix6::Identity()});
  const auto result = optimized(graph);
  EXPECT_TRUE(result.poses[1].matrix().allFinite());
  EXPECT_LE(result.chi2_after, result.chi2_before);
}

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

TEST(PoseGraphCovariances, AreTheInverseOfTheInformation)
{
  const PoseGraph graph = ringGraph(15, 0.1, 13);
  PoseGraphOptimizer optimizer(graph);
  PoseGraph solved = graph;
  solved.poses = optimizer.optimize().poses;
  const Eigen::MatrixXd inverse = denseInformation(solved).inverse();
  const auto covariances = optimizer.marginalCovariances();
  ASSERT_EQ(covariances.size(), graph.poses.size());
  EXPECT_EQ(covariances[0], Matrix6::Zero());
  for (std::size_t i = 1; i < covariances.size(); ++i)
    EXPECT_TRUE(
        covariances[i].isApprox(inverse.block<6, 6>(6 * i - 6, 6 * i - 6), 1e-9))
        << "pose " << i;
  const auto relative = [&](std::size_t a, std::size_t b) -> Matrix6 {
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(6, inverse.cols() + 6);
    J.block<6, 6>(0, 6 * a) =
        -pcl6d::adjointOf(solved.poses[b].inverse() * solved.poses[a]);
    J.block<6, 6>(0, 6 * b) = Matrix6::Identity();
    const Eigen::MatrixXd K = J.rightCols(inverse.cols());
    return K * inverse * K.transpose();
  };
  for (const auto& [a, b] :
       {std::pair<std::size_t, std::size_t>{3, 7}, {7, 3}, {14, 0}})
    EXPECT_TRUE(optimizer.relativeCovariance(a, b).isApprox(relative(a, b), 1e-9));
  EXPECT_TRUE(optimizer.relativeCovariance(0, 5).isApprox(covariances[5], 1e-9));
  EXPECT_EQ(optimizer.relativeCovariance(4, 4), Matrix6::Zero());
}

TEST(PoseGraphCovariances, NeedAConnection)
{
  PoseGraphOptimizer optimizer(twoRings(0.1));
  optimizer.optimize();
  EXPECT_EQ(optimizer.marginalCovariances()[10], Matrix6::Zero());
  EXPECT_THROW(optimizer.relativeCovariance(3, 12), pcl6d::BadArgument);
  EXPECT_THROW(optimizer.relativeCovariance(3, 99), pcl6d::BadArgument);
}
