// SPDX-License-Identifier: BSD-3-Clause
// Scans behind a break that match each other: registered with each other, beside the map.
#include "registered_run.h"
#include "ring_run.h"

#include <algorithm>

namespace {
using pcl6d::poseFromEuler;
using pcl6d::RecoveredBy;
using pcl6d::ScanState;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::test::DriftingRun;
using pcl6d::test::makeRunAlong;
using pcl6d::test::PillarRoom;
using pcl6d::test::registered;

constexpr std::size_t kBefore = 5, kBehind = 4;

/** \return a short drive through a room */
std::vector<Eigen::Isometry3d>
pathFrom(double x, std::size_t count)
{
  std::vector<Eigen::Isometry3d> path;
  for (std::size_t i = 0; i < count; ++i)
    path.push_back(poseFromEuler({x + 0.4 * static_cast<double>(i), 0, 0},
                                 {0, 0, 0.05 * static_cast<double>(i)}));
  return path;
}

/** \return a drive that breaks off in one room and goes on in another one, from where no surface of
 * the first is seen; the odometry drifts by 5 cm a scan */
DriftingRun
brokenRun()
{
  PillarRoom other;
  other.walls = {Eigen::Vector3d(25, -2, -1), Eigen::Vector3d(45, 3.5, 4)};
  other.pillars = {{Eigen::Vector3d(32, 2, -1), Eigen::Vector3d(33.2, 2.5, 1)},
                   {Eigen::Vector3d(37, -1, -1), Eigen::Vector3d(37.5, 0, 3)}};
  DriftingRun run = makeRunAlong(pathFrom(-1, kBefore), {});
  const DriftingRun behind = makeRunAlong(pathFrom(29, kBehind), other);
  const Eigen::Isometry3d over =
      run.odometry.back() * run.truth.back().inverse() * behind.truth.front();
  for (std::size_t i = 0; i < kBehind; ++i) {
    run.scans.push_back(behind.scans[i]);
    run.truth.push_back(behind.truth[i]);
    run.odometry.push_back(over * behind.odometry.front().inverse() *
                           behind.odometry[i]);
  }
  return run;
}

/** \return [m] error of the step to a scan */
double
stepError(std::size_t scan, const Slam6DResult& result, const DriftingRun& run)
{
  const Eigen::Isometry3d step =
      result.scans[scan - 1].T_world_scan.inverse() * result.scans[scan].T_world_scan;
  const Eigen::Isometry3d truth = run.truth[scan - 1].inverse() * run.truth[scan];
  return (step.translation() - truth.translation()).norm();
}

const Slam6DResult&
broken()
{
  static const Slam6DResult result = registered(brokenRun());
  return result;
}

TEST(RegisterPieces, ScansBehindABreakAreRegisteredWithEachOther)
{
  const DriftingRun run = brokenRun();
  const auto& scans = broken().scans;
  EXPECT_EQ(scans[kBefore].state, ScanState::kPredicted)
      << "the first hangs on odometry";
  EXPECT_FALSE(scans[kBefore].rejections.empty());
  for (std::size_t i = kBefore + 1; i < kBefore + kBehind; ++i) {
    EXPECT_EQ(scans[i].state, ScanState::kMatched) << i;
    EXPECT_EQ(scans[i].recovered, RecoveredBy::kBeside);
    EXPECT_TRUE(scans[i].rejections.empty());
    EXPECT_GT(scans[i].overlap, 0.5);
    EXPECT_LT(stepError(i, broken(), run), 0.025) << "the odometry's is 0.05";
  }
}

TEST(RegisterPieces, TheBreakKeepsTheOdometry)
{
  const DriftingRun run = brokenRun();
  const Eigen::Isometry3d step = broken().scans[kBefore - 1].T_world_scan.inverse() *
                                 broken().scans[kBefore].T_world_scan;
  const Eigen::Isometry3d given =
      run.odometry[kBefore - 1].inverse() * run.odometry[kBefore];
  EXPECT_LT((step.matrix() - given.matrix()).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(RegisterPieces, ThePieceIsNoPartOfTheMap)
{
  const Slam6DResult& result = broken();
  EXPECT_FALSE(result.trusted());
  ASSERT_TRUE(result.verification);
  for (std::size_t i = 0; i < kBefore + kBehind; ++i)
    EXPECT_EQ(result.verification->scans[i].tied, i < kBefore) << i;
  const std::vector<std::size_t> expected = {kBefore + 1, kBefore + 2, kBefore + 3};
  EXPECT_EQ(result.floating, expected);
  EXPECT_TRUE(result.verification->scans[kBefore - 1].bound);
}

TEST(RegisterPieces, AFurtherCallChangesNothing)
{
  const DriftingRun run = brokenRun();
  pcl6d::Slam6D slam;
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    slam.addScan(run.scans[i], run.odometry[i]);
  ASSERT_TRUE(slam.optimize());
  const Slam6DResult once = slam.result();
  ASSERT_TRUE(slam.optimize());
  pcl6d::test::expectSameBits(once, slam.result());
  EXPECT_EQ(once.floating, slam.result().floating);
}

TEST(RegisterPieces, ScansAddedLaterAreNotMatchedWithThePiece)
{
  DriftingRun run = brokenRun();
  pcl6d::Slam6D slam;
  const std::size_t all = run.scans.size();
  for (std::size_t i = 0; i + 1 < all; ++i)
    slam.addScan(run.scans[i], run.odometry[i]);
  ASSERT_TRUE(slam.optimize());
  EXPECT_EQ(slam.result().floating.size(), kBehind - 2);
  slam.addScan(run.scans[all - 1], run.odometry[all - 1]);
  ASSERT_TRUE(slam.optimize());
  const std::vector<std::size_t> expected = {kBefore + 1, kBefore + 2, kBefore + 3};
  EXPECT_EQ(slam.result().floating, expected);
  for (std::size_t i = kBefore; i < all; ++i) {
    EXPECT_FALSE(slam.result().verification->scans[i].tied) << i;
    EXPECT_TRUE(i == kBefore ||
                slam.result().scans[i].recovered == RecoveredBy::kBeside)
        << i;
  }
}

TEST(RegisterPieces, ThePieceSeesNothingMove)
{
  // The odometry leads the piece into the room of the map, whose walls its rays pass through.
  DriftingRun run = brokenRun();
  const Eigen::Isometry3d back = run.odometry[kBefore - 1] *
                                 poseFromEuler({0.3, 0, 0}, {}) *
                                 run.odometry[kBefore].inverse();
  for (std::size_t i = kBefore; i < run.odometry.size(); ++i)
    run.odometry[i] = back * run.odometry[i];
  const Slam6DResult result = registered(run);
  EXPECT_FALSE(result.trusted());
  EXPECT_EQ(result.count(ScanState::kPredicted), 1u);
  ASSERT_TRUE(result.moving);
  EXPECT_EQ(result.moving->moving, 0u);
}

TEST(RegisterPieces, WithoutAVerdictThePieceFollowsTheOdometry)
{
  Slam6DOptions options;
  options.verify = false;
  const Slam6DResult result = registered(brokenRun(), options);
  for (std::size_t i = kBefore; i < kBefore + kBehind; ++i)
    EXPECT_EQ(result.scans[i].state, ScanState::kPredicted) << i;
}
} // namespace
