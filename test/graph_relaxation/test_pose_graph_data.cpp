// SPDX-License-Identifier: BSD-3-Clause
#include "graph_cases.h"
#include "support/data_folder.h"

#include <pcl6d/graph_relaxation/link_error.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>
#include <pcl6d/io/pose_graph_io.h>

using pcl6d::GraphMethod;
using pcl6d::PoseGraph;
using pcl6d::PoseGraphOptimizer;
using pcl6d::PoseGraphOptions;
using pcl6d::Status;

namespace {
constexpr double kSameOptimum = 1e-6; // relative
constexpr double kSameStart = 1e-9;   // relative: the digits that are known

void
expectOptimum(const PoseGraph& graph, double start, double optimum)
{
  EXPECT_NEAR(chi2Of(graph), start, kSameStart * start);
  for (const GraphMethod method :
       {GraphMethod::kGaussNewton, GraphMethod::kLevenbergMarquardt}) {
    PoseGraphOptions options;
    options.method = method;
    const auto result = PoseGraphOptimizer(graph, options).optimize();
    EXPECT_EQ(result.status, Status::kOk);
    EXPECT_NEAR(result.chi2_after, optimum, kSameOptimum * optimum);
    EXPECT_EQ(result.components.size(), 1u);
  }
}
} // namespace

TEST(PoseGraphData, TheGarageReachesItsOptimum)
{
  PCL6D_DATA_OR_SKIP(folder, "graphs");
  expectOptimum(
      pcl6d::readPoseGraph(folder / "parking-garage.g2o"), 16720.01817, 1.238690580);
}

TEST(PoseGraphData, TheSphereReachesItsOptimumFromItsChain)
{
  PCL6D_DATA_OR_SKIP(folder, "graphs");
  expectOptimum(
      pcl6d::readPoseGraph(folder / "sphere2500.txt"), 2547812.218, 728.8538999);
}

TEST(PoseGraphData, TheSphereComesNearItsTruth)
{
  PCL6D_DATA_OR_SKIP(folder, "graphs");
  const PoseGraph truth = pcl6d::readPoseGraph(folder / "sphere2500_groundtruth.txt");
  const PoseGraph graph = pcl6d::readPoseGraph(folder / "sphere2500.txt");
  const auto before = pcl6d::test::largestDifference(graph.poses, truth.poses);
  const auto poses = PoseGraphOptimizer(graph).optimize().poses;
  EXPECT_GT(before, 20);
  EXPECT_LT(pcl6d::test::largestDifference(poses, truth.poses), 5); // [m] + [rad]
}
