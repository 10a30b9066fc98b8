// SPDX-License-Identifier: BSD-3-Clause
#include "graph/graph_links.h"
#include "support/points.h"

#include <pcl6d/common/pose.h>

#include <gtest/gtest.h>

using pcl6d::LoopEdge;
using pcl6d::PerDimension;
using pcl6d::ScanLink;
using pcl6d::ScanResult;
using pcl6d::ScanState;
using pcl6d::slam6d::chainOf;
using pcl6d::slam6d::costOf;
using pcl6d::slam6d::driftOf;

namespace {
constexpr double kLinkVoxel = 0.2; // [m]

using Matrix6 = Eigen::Matrix<double, 6, 6>;

Matrix6
diagonal(double variance_of_position, double variance_of_rotation)
{
  Matrix6 C = Matrix6::Zero();
  C.diagonal().head<3>().setConstant(variance_of_position);
  C.diagonal().tail<3>().setConstant(variance_of_rotation);
  return C;
}

/** Steps of 2 m; each scan matched with another covariance but the one in the middle. */
std::vector<ScanResult>
chain()
{
  std::vector<ScanResult> scans(4);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    scans[i].initial_pose.translation().x() = 2.0 * static_cast<double>(i);
    scans[i].T_world_scan = scans[i].initial_pose;
    scans[i].state = ScanState::kMatched;
    const auto k = static_cast<double>(i);
    scans[i].covariance = diagonal(k * 1e-4, k * 1e-6);
  }
  scans[2].state = ScanState::kPredicted;
  return scans;
}
} // namespace

TEST(ChainOf, CostsWhatTheMatchesLeaveOpen)
{
  const std::vector<LoopEdge> edges = chainOf(chain(), 4, kLinkVoxel);
  ASSERT_EQ(edges.size(), 3u);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EXPECT_EQ(edges[i].a, i);
    EXPECT_EQ(edges[i].b, i + 1);
  }
  EXPECT_TRUE(edges[0].cost.isApprox(PerDimension(1e-4, 1e-4, 1e-4, 3e-6)));
  EXPECT_TRUE(edges[2].cost.isApprox(PerDimension(3e-4, 3e-4, 3e-4, 9e-6)));
  const double sigma = 0.05 + 0.05 * 2; // of the odometry: a quarter voxel, 5 % of 2 m
  EXPECT_NEAR(edges[1].cost[0], sigma * sigma, 1e-12);
  EXPECT_NEAR(edges[1].cost[3], 3 * 0.03 * 0.03, 1e-12);
  EXPECT_EQ(chainOf(chain(), 2, kLinkVoxel).size(), 1u);
  EXPECT_TRUE(chainOf({}, 0, kLinkVoxel).empty());
}

TEST(ChainOf, CostsOfPositionsFollowTheScale)
{
  std::vector<ScanResult> scaled = chain();
  for (ScanResult& scan : scaled) {
    scan.initial_pose.translation() *= 100;
    scan.covariance->topLeftCorner<3, 3>() *= 1e4;
  }
  const std::vector<LoopEdge> here = chainOf(chain(), 4, kLinkVoxel),
                              there = chainOf(scaled, 4, 100 * kLinkVoxel);
  for (std::size_t i = 0; i < here.size(); ++i) {
    EXPECT_TRUE(there[i].cost.head<3>().isApprox(1e4 * here[i].cost.head<3>()));
    EXPECT_DOUBLE_EQ(there[i].cost[3], here[i].cost[3]);
  }
}

TEST(CostOf, IsThatOfTheLoopsCovarianceIfItIsKnown)
{
  ScanLink loop;
  EXPECT_FALSE(costOf(loop));
  loop.covariance = diagonal(4e-4, 1e-6);
  EXPECT_FALSE(costOf(loop)) << "never matched";
  loop.T_from_to = pcl6d::poseFromEuler({1, 2, 3}, {0, 0, 0});
  ASSERT_TRUE(costOf(loop));
  EXPECT_TRUE(costOf(loop)->isApprox(PerDimension(4e-4, 4e-4, 4e-4, 3e-6)));
}

TEST(DriftOf, AddsUpAlongTheWay)
{
  const auto drift = driftOf(chain(), 4, kLinkVoxel);
  ASSERT_EQ(drift.size(), 4u);
  for (std::size_t i = 1; i < drift.size(); ++i)
    EXPECT_GT(drift[i].trace(), drift[i - 1].trace());
  EXPECT_NEAR(drift[1](0, 0), 1e-4 + 4e-8, 1e-12);
  EXPECT_GT(drift[0](0, 0), 0) << "still an uncertainty";
}
