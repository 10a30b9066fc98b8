// SPDX-License-Identifier: BSD-3-Clause
#include "graph_cases.h"

#include <pcl6d/graph_relaxation/link_error.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>

#include <gtest/gtest.h>

using pcl6d::PoseGraph;
using pcl6d::PoseGraphOptimizer;
using pcl6d::PoseGraphOptions;
using pcl6d::RobustKernel;
using pcl6d::Status;
using pcl6d::test::largestDifference;

namespace {
constexpr double kNoise = 0.02; // [m], [rad] of the right links

/** A ring whose chords with an odd number are wrong. */
struct WrongLoops {
  WrongLoops()
  {
    graph = pcl6d::test::ringGraph(60, kNoise, 21);
    truth = graph.poses;
    pcl6d::Random random(22);
    for (std::size_t k = 60; k < graph.links.size(); ++k)
      if (k % 2 == 1) {
        graph.links[k].T_from_to = pcl6d::test::randomPose(random, 10, 2);
        wrong.push_back(k);
      }
    for (auto& link : graph.links) // what the noise deserves
      link.information.setIdentity() /= kNoise * kNoise;
    pcl6d::test::startFromChain(graph);
    right = graph;
    for (auto k = wrong.rbegin(); k != wrong.rend(); ++k)
      right.links.erase(right.links.begin() + static_cast<std::ptrdiff_t>(*k));
  }
  PoseGraph graph, right; ///< the second without the wrong links
  std::vector<Eigen::Isometry3d> truth;
  std::vector<std::size_t> wrong;
};

double
slopeOf(RobustKernel kernel, double r, double width)
{
  switch (kernel) {
  case RobustKernel::kHuber:
    return r <= width ? 1 : width / r;
  case RobustKernel::kCauchy:
    return 1 / (1 + r * r / (width * width));
  case RobustKernel::kGemanMcClure:
    return 1 / std::pow(1 + r * r / (width * width), 2);
  default:
    return 1;
  }
}
} // namespace

TEST(RobustPoseGraph, WrongLinksSpoilLeastSquares)
{
  const WrongLoops loops;
  const auto poses = PoseGraphOptimizer(loops.graph).optimize().poses;
  EXPECT_GT(largestDifference(poses, loops.truth), 2);
}

TEST(RobustPoseGraph, GraduatedNonConvexitySwitchesWrongLinksOff)
{
  const WrongLoops loops;
  const auto expected = PoseGraphOptimizer(loops.right).optimize().poses;
  for (const bool trust_chain : {false, true}) {
    SCOPED_TRACE(trust_chain);
    PoseGraphOptions options;
    options.graduated = true;
    options.trust_chain = trust_chain;
    const auto result = PoseGraphOptimizer(loops.graph, options).optimize();
    EXPECT_EQ(result.status, Status::kOk);
    // Right links lose some weight to the kernel, so the noise moves the poses a bit
    // more.
    EXPECT_LT(largestDifference(result.poses, loops.truth),
              1.5 * largestDifference(expected, loops.truth));
    for (const std::size_t k : loops.wrong)
      EXPECT_LT(result.weights[k], 1e-3) << "link " << k;
    for (std::size_t k = 0; k < 60; ++k)
      EXPECT_GT(result.weights[k], trust_chain && k < 59 ? 0.999 : 0.1) << "link " << k;
  }
}

TEST(RobustPoseGraph, EveryKernelEndsAtItsOwnStationaryPoint)
{
  const PoseGraph graph = pcl6d::test::ringGraph(30, 0.3, 23);
  for (const RobustKernel kernel :
       {RobustKernel::kHuber, RobustKernel::kCauchy, RobustKernel::kGemanMcClure}) {
    SCOPED_TRACE(toString(kernel));
    PoseGraphOptions options;
    options.robust = kernel;
    options.chi2_epsilon = 1e-14;
    options.max_iterations = 1000;
    const auto result = PoseGraphOptimizer(graph, options).optimize();
    EXPECT_EQ(result.status, Status::kOk);
    // The weights of an error r, and forces that cancel at each pose.
    std::vector<pcl6d::Vector6> force(graph.poses.size(), pcl6d::Vector6::Zero());
    double largest = 0;
    for (std::size_t k = 0; k < graph.links.size(); ++k) {
      const auto& link = graph.links[k];
      const auto linear =
          pcl6d::linearizeLink(link, result.poses[link.from], result.poses[link.to]);
      const double r = std::sqrt(linear.error.dot(link.information * linear.error));
      const double slope = slopeOf(kernel, r, options.robust_width);
      EXPECT_NEAR(result.weights[k], slope, 1e-9);
      const pcl6d::Vector6 pull = slope * link.information * linear.error;
      force[link.from] += linear.J_from.transpose() * pull;
      force[link.to] += linear.J_to.transpose() * pull;
      largest = std::max(largest, (linear.J_to.transpose() * pull).norm());
    }
    for (std::size_t i = 1; i < force.size(); ++i)
      EXPECT_LT(force[i].norm(), 1e-4 * largest) << "pose " << i;
  }
}

TEST(RobustPoseGraph, AWideKernelIsLeastSquares)
{
  const PoseGraph graph = pcl6d::test::ringGraph(30, 0.1, 24);
  const auto expected = PoseGraphOptimizer(graph).optimize().poses;
  for (const RobustKernel kernel :
       {RobustKernel::kHuber, RobustKernel::kCauchy, RobustKernel::kGemanMcClure}) {
    PoseGraphOptions options;
    options.robust = kernel;
    options.robust_width = 1e6;
    const auto result = PoseGraphOptimizer(graph, options).optimize();
    EXPECT_LT(largestDifference(result.poses, expected), 1e-4) << toString(kernel);
  }
}
