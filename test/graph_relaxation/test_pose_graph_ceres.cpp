// SPDX-License-Identifier: BSD-3-Clause
// Ceres as an independent oracle.
#include "graph_cases.h"
#include "support/ceres_graph.h"

#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>

#include <gtest/gtest.h>

using pcl6d::PoseGraph;
using pcl6d::PoseGraphOptimizer;
using pcl6d::PoseGraphOptions;
using pcl6d::test::largestDifference;

TEST(PoseGraphOptimizer, EndsWhereCeresEnds)
{
  for (const double noise : {0.01, 0.1, 0.3}) {
    SCOPED_TRACE(noise);
    PoseGraph graph = pcl6d::test::ringGraph(80, noise, 31);
    pcl6d::Random random(1);
    for (std::size_t i = 1; i < graph.poses.size(); ++i)
      graph.poses[i] = pcl6d::test::disturbed(graph.poses[i], random, 0.2);
    PoseGraphOptions options;
    options.chi2_epsilon = 1e-12;
    options.max_iterations = 500; // large residuals make Gauss-Newton linear
    const auto result = PoseGraphOptimizer(graph, options).optimize();
    double chi2 = 0;
    const auto poses =
        pcl6d::test::optimizeByCeres(graph, ceres::EIGEN_SPARSE, 1e-13, 1, &chi2);
    EXPECT_EQ(result.status, pcl6d::Status::kOk);
    EXPECT_NEAR(result.chi2_after, chi2, 1e-9 * chi2);
    // Near a minimum, chi2 within 1e-12 leaves the poses its root times their noise.
    EXPECT_LT(largestDifference(result.poses, poses), 1e-5);
  }
}
