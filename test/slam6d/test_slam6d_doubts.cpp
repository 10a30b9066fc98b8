// SPDX-License-Identifier: BSD-3-Clause
// Matches that Slam6D must not believe, whatever ICP says.
#include "matching/agreement.h"
#include "room_scans.h"
#include "support/constants.h"
#include "support/points.h"

#include <pcl6d/slam6d/slam6d.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

using pcl6d::Metric;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::RecoveryEffort;
using pcl6d::ScanResult;
using pcl6d::ScanState;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::Status;
using pcl6d::test::kIdentity;
using pcl6d::test::parallelWalls;
using pcl6d::test::smoothPipe;
using pcl6d::test::TornPair;

namespace {

/** \return the second of two scans */
ScanResult
secondOf(const Points& first,
         const Points& second,
         const Eigen::Isometry3d& odometry,
         const Slam6DOptions& options)
{
  Slam6D slam(options);
  slam.addScan(first, kIdentity);
  slam.addScan(second, odometry);
  EXPECT_TRUE(slam.optimize());
  return slam.result().scans[1];
}

/** \return options that pair points far apart: ICP pulls the second scan of a TornPair away */
Slam6DOptions
tearingOptions()
{
  Slam6DOptions options;
  options.metric = Metric::kPoint;
  options.voxel = 0.1;
  options.max_distance = 3; // far too wide
  options.max_distance_start = 0;
  options.recovery = RecoveryEffort::kOff; // would find the place in spite of all that
  return options;
}
} // namespace

TEST(Slam6DDoubts, AMatchMustNotLetFewerPointsMeet)
{
  const TornPair pair;
  const ScanResult torn =
      secondOf(pair.first, pair.second, pair.truth, tearingOptions());
  EXPECT_EQ(torn.status, Status::kOk) << toString(torn.status);
  EXPECT_EQ(torn.state, ScanState::kPredicted);
  const pcl6d::Rejection& lost = torn.rejections.front();
  EXPECT_EQ(lost.reason, pcl6d::RejectReason::kAgreementLost);
  EXPECT_LT(lost.measured, lost.needed);
  EXPECT_GT(torn.correction, 0.1) << "which would have been the damage";
  EXPECT_FALSE(torn.covariance);
  EXPECT_LT(pcl6d::distanceBetween(torn.T_world_scan, pair.truth).translation, 1e-12);
}

TEST(Slam6DDoubts, AnUnregisteredScanIsNotConnectedEvenAtItsTruePose)
{
  const TornPair pair;
  Slam6D slam(tearingOptions());
  slam.addScan(pair.first, kIdentity);
  slam.addScan(pair.second, pair.truth);
  ASSERT_TRUE(slam.optimize());
  ASSERT_EQ(slam.result().scans[1].state, ScanState::kPredicted);
  ASSERT_TRUE(slam.result().verification);
  const pcl6d::MapVerification& map = *slam.result().verification;
  EXPECT_EQ(map.count(pcl6d::LinkTrust::kGood), 1U) << "the link is tested, and right";
  EXPECT_TRUE(map.scans[0].tied);
  EXPECT_FALSE(map.scans[1].tied);
  EXPECT_FALSE(map.scans[1].bound) << "the bound of a predicted pose is not known";
  EXPECT_EQ(map.scans[1].doubt.reason, pcl6d::RejectReason::kScanUnregistered);
  EXPECT_EQ(map.trust, pcl6d::MapTrust::kDoubtful);
}

TEST(Slam6DDoubts, AMatchThatLetsMorePointsMeetIsBelieved)
{
  const TornPair pair;
  const Eigen::Isometry3d odometry =
      pair.truth * pcl6d::poseFromEuler({0.1, 0.1, 0.05}, {0, 0, 0.05});
  Slam6DOptions options;
  options.voxel = 0.1;
  options.max_distance_start = 0.6; // [m] less wide than what is torn
  const ScanResult matched = secondOf(pair.first, pair.second, odometry, options);
  EXPECT_EQ(matched.state, ScanState::kMatched) << toWords(matched.rejections);
  EXPECT_TRUE(matched.rejections.empty());
  EXPECT_LT(pcl6d::distanceBetween(matched.T_world_scan, pair.truth).translation, 0.05);
}

class Corridors : public testing::TestWithParam<std::string> {};

TEST_P(Corridors, AreNotCalledMatched)
{
  Slam6DOptions options;
  options.metric = pcl6d::metricFromName(GetParam());
  const Eigen::Isometry3d odometry = pcl6d::poseFromEuler({1, 0.02, 0.01}, {});
  for (const auto scan : {smoothPipe, parallelWalls}) {
    SCOPED_TRACE(scan == smoothPipe ? "pipe" : "parallel walls");
    Random random(6);
    const Points first = scan(random, 0), second = scan(random, 1.3);
    ScanResult result = secondOf(first, second, odometry, options);
    EXPECT_EQ(result.state, ScanState::kPredicted);
    EXPECT_FALSE(result.rejections.empty());
    EXPECT_FALSE(result.covariance);
    EXPECT_EQ(pcl6d::distanceBetween(result.T_world_scan, odometry).translation, 0);
    if (options.metric == Metric::kGicp) {
      EXPECT_EQ(result.status, Status::kRankDeficient);
      ASSERT_EQ(result.rejections.size(), 2u) << toWords(result.rejections);
      EXPECT_EQ(result.rejections[0].reason, pcl6d::RejectReason::kIcpFailed);
      EXPECT_EQ(result.rejections[1].reason, pcl6d::RejectReason::kNoPoseInMap);
      EXPECT_EQ(result.rejections[1].causes.front().reason,
                pcl6d::RejectReason::kSecondPose);
    }
    // Nor without the doubt about long ways, which some steps along the pipe raise.
    options.max_correction = std::numeric_limits<double>::infinity();
    result = secondOf(first, second, odometry, options);
    EXPECT_NE(result.state, ScanState::kMatched) << toString(result.status);
    options.max_correction = Slam6DOptions().max_correction;
  }
}

INSTANTIATE_TEST_SUITE_P(AllMetrics,
                         Corridors,
                         testing::ValuesIn(pcl6d::metricNames()),
                         [](const auto& one) { return one.param; });

TEST(Agreement, IsTheShareOfPointsThatHaveAPointNear)
{
  pcl6d::IcpModel::Options options;
  const pcl6d::IcpModel first(Points{{0, 0, 0}, {1, 0, 0}}, options);
  const pcl6d::IcpModel second(Points{{0, 0, 0}}, options);
  const pcl6d::IcpTarget target = {first.part(),
                                   second.part(pcl6d::poseFromEuler({5, 0, 0}, {}))};
  const Points points = {{-1, 0.05f, 0},             // at 0: near
                         {0, 0.2f, 0},               // at 1: not near
                         {4, 0, 0.05f},              // at 5: near, in the other part
                         {2, 0, 0},                  // at 3: not near
                         {pcl6d::test::kNan, 0, 0}}; // does not count
  const Eigen::Isometry3d T = pcl6d::poseFromEuler({1, 0, 0}, {});
  for (const unsigned int threads : {1u, 2u, 8u})
    EXPECT_EQ(pcl6d::slam6d::agreementOf(target, points, T, 0.1, threads), 0.5);
  EXPECT_EQ(pcl6d::slam6d::agreementOf(target, points, T, 0.3, 1), 0.75);
  EXPECT_EQ(pcl6d::slam6d::agreementOf(target, Points(), T, 0.3, 1), 0);
  EXPECT_EQ(pcl6d::slam6d::agreementOf({}, points, T, 0.3, 1), 0);
}

TEST(Agreement, OfManyPointsIsThatOfASample)
{
  // Three of four points have a partner: a sample of 5000 and more finds that to 1 %.
  Random random(4);
  const Points cube = pcl6d::test::randomCube(random, 40000, 10);
  Points points = cube;
  for (auto& p : points)
    if (random.uniform(0, 1) < 0.25)
      p.x() += 100;
  const pcl6d::IcpModel model(cube, {});
  const double share =
      pcl6d::slam6d::agreementOf({model.part()}, points, kIdentity, 0.01, 1);
  EXPECT_NEAR(share, 0.75, 0.02);
  for (const unsigned int threads : {2u, 3u, 8u})
    EXPECT_EQ(
        pcl6d::slam6d::agreementOf({model.part()}, points, kIdentity, 0.01, threads),
        share);
}
