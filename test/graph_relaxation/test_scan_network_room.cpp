// SPDX-License-Identifier: BSD-3-Clause
#include "network_scans.h"
#include "support/bits.h"

#include <pcl6d/graph_relaxation/graph_slam.h>
#include <pcl6d/graph_relaxation/scan_network.h>

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

using pcl6d::GraphSlam;
using pcl6d::GraphSlamResult;
using pcl6d::LinkPairs;
using pcl6d::Metric;
using pcl6d::Poses;
using pcl6d::ScanNetwork;
using pcl6d::ScanNetworkOptions;
using pcl6d::test::NetworkScans;

namespace {
const NetworkScans&
smallRing()
{
  static const NetworkScans scans = pcl6d::test::scansFrom(pcl6d::test::ringPoses(10));
  return scans;
}

const Poses&
turnedRing()
{
  static const Poses poses = pcl6d::test::drifted(
      smallRing().truth,
      pcl6d::poseFromEuler({0.02, -0.01, 0.01}, {0.003, -0.003, 0.006}));
  return poses;
}

ScanNetwork
networkOf(Metric metric, unsigned int num_threads = 0)
{
  ScanNetworkOptions options;
  options.metric = metric;
  options.max_distance = 0.4;
  options.num_threads = num_threads;
  return {
      smallRing().scans, std::vector<bool>(smallRing().scans.size(), true), options};
}

GraphSlamResult
relaxed(Metric metric, unsigned int num_threads = 0)
{
  ScanNetwork network = networkOf(metric, num_threads);
  return GraphSlam().relax(turnedRing(),
                           [&](const Poses& now) { return network.pairs(now); });
}
} // namespace

TEST(ScanNetwork, GivesNormsByTheMetric)
{
  for (const LinkPairs& link : networkOf(Metric::kPlane).pairs(smallRing().truth)) {
    ASSERT_EQ(link.norms.size(), link.points_from.size());
    for (const Eigen::Matrix3d& norm : link.norms) {
      EXPECT_TRUE((norm * norm).isApprox(norm, 1e-5)) << "a projection";
      EXPECT_NEAR(norm.trace(), 1, 1e-5) << "on a line";
    }
  }
  for (const LinkPairs& link : networkOf(Metric::kGicp).pairs(smallRing().truth)) {
    ASSERT_EQ(link.norms.size(), link.points_from.size());
    for (const Eigen::Matrix3d& norm : link.norms) {
      const Eigen::Vector3d values =
          Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(norm).eigenvalues();
      EXPECT_GT(values[0], 0);
      EXPECT_LT(values[2], 1 + 1e-6);
    }
  }
}

TEST(ScanNetwork, NormsAreInTheAxesOfTheWorld)
{
  // Turned by a right angle about x, floor and ceiling stand upright, with normals
  // along y.
  pcl6d::Points floor;
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < 20; ++k)
      floor.emplace_back(
          0.3f * static_cast<float>(i), 0.3f * static_cast<float>(k), -1);
  NetworkScans scans;
  const Eigen::Isometry3d upright = pcl6d::poseFromEuler({0, 0, 0}, {M_PI / 2, 0, 0});
  scans.add(floor, upright);
  scans.add(floor, upright);
  ScanNetworkOptions options;
  options.metric = Metric::kPlane;
  ScanNetwork plane(scans.scans, {true, true}, options);
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  const auto plane_pairs = plane.pairs(scans.truth);
  for (const Eigen::Matrix3d& norm : plane_pairs.at(0).norms)
    EXPECT_TRUE(norm.isApprox(y * y.transpose(), 1e-5));
  options.metric = Metric::kGicp;
  ScanNetwork gicp(scans.scans, {true, true}, options);
  const auto gicp_pairs = gicp.pairs(scans.truth);
  for (const Eigen::Matrix3d& norm : gicp_pairs.at(0).norms) {
    EXPECT_NEAR(norm(1, 1), 1, 1e-4);
    EXPECT_NEAR(norm(0, 0), options.gicp_epsilon, 1e-4);
    EXPECT_NEAR(norm(2, 2), options.gicp_epsilon, 1e-4);
  }
}

TEST(ScanNetwork, WithGraphSlamBringsADriftedRingToTheTruth)
{
  const double before = pcl6d::test::largestError(turnedRing(), smallRing().truth);
  EXPECT_GT(before, 0.1);
  for (const Metric metric : {Metric::kPoint, Metric::kPlane, Metric::kGicp}) {
    const GraphSlamResult result = relaxed(metric);
    const double after = pcl6d::test::largestError(result.poses, smallRing().truth);
    EXPECT_LT(after, metric == Metric::kPoint ? 0.5 * before : 0.02)
        << toString(metric);
  }
}

TEST(ScanNetwork, GivesTheSameBitsForAnyNumberOfThreads)
{
  const GraphSlamResult one = relaxed(Metric::kGicp, 1);
  for (const unsigned int threads : {2u, 8u}) {
    const GraphSlamResult many = relaxed(Metric::kGicp, threads);
    for (std::size_t i = 0; i < one.poses.size(); ++i)
      EXPECT_TRUE(pcl6d::test::sameBits(many.poses[i], one.poses[i])) << i;
  }
}

TEST(ScanNetwork, DescribesHowWellTheSurfacesFixALink)
{
  ScanNetwork room = networkOf(Metric::kPlane);
  room.pairs(smallRing().truth);
  for (const pcl6d::ScanLink& link : room.describe(smallRing().truth)) {
    EXPECT_GT(link.condition, 0.01);
    EXPECT_LE(link.condition, 1);
    EXPECT_GE(link.overlap, 0.54);
  }
}
