// SPDX-License-Identifier: BSD-3-Clause
#include "graph_cases.h"

#include <pcl6d/common/error.h>
#include <pcl6d/graph_relaxation/link_error.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>

#include <Eigen/LU>
#include <gtest/gtest.h>

using pcl6d::Matrix6;
using pcl6d::PoseGraph;
using pcl6d::PoseGraphOptimizer;
using pcl6d::test::ringGraph;
using pcl6d::test::twoRings;

namespace {
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
} // namespace

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
