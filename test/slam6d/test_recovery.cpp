// SPDX-License-Identifier: BSD-3-Clause
// Scans that cannot be matched where the odometry expects them, and all after them: jumps,
// turns, scans of elsewhere and pieces that meet the map again later, with exact truth.
#include "corridor_drive.h"
#include "recovery/motion_guesses.h"
#include "registered_run.h"
#include "support/points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

using pcl6d::distanceBetween;
using pcl6d::MapTrust;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::RecoveredBy;
using pcl6d::RecoveryEffort;
using pcl6d::ScanResult;
using pcl6d::ScanState;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::test::DriftingRun;
using pcl6d::test::expectSameBits;
using pcl6d::test::makeCorridorRun;
using pcl6d::test::movedBy;
using pcl6d::test::PillarRoom;
using pcl6d::test::registered;
using pcl6d::test::roomOfElsewhere;

namespace {
// Ends of a chain of matches are off by up to half a voxel without any fault, too; wrong places
// are several voxels away.
constexpr double kShareOfVoxel = 1;
constexpr double kTurnTol = 0.01; // [rad]

/** Expects scans where they were taken, seen from the first one.
 * \param[in] but those in between, which were lost */
void
expectTruth(const Slam6DResult& result,
            const DriftingRun& run,
            const std::vector<std::size_t>& but = {})
{
  for (std::size_t i = 0; i < run.truth.size(); ++i) {
    SCOPED_TRACE("scan " + std::to_string(i));
    const ScanResult& scan = result.scans[i];
    if (std::find(but.begin(), but.end(), i) != but.end()) {
      EXPECT_EQ(scan.state, ScanState::kPredicted);
      EXPECT_FALSE(scan.rejections.empty());
      continue;
    }
    EXPECT_NE(scan.state, ScanState::kPredicted) << toWords(scan.rejections);
    const auto off =
        distanceBetween(run.truth[0].inverse() * run.truth[i],
                        result.scans[0].T_world_scan.inverse() * scan.T_world_scan);
    EXPECT_LT(off.translation, kShareOfVoxel * result.parameters.voxel.value);
    EXPECT_LT(off.rotation, kTurnTol);
  }
}

/** A drive that is carried away after a few scans, without the odometry noticing, to where
 * nothing of the map is seen, and comes back. */
DriftingRun
carriedAway()
{
  Random random(5);
  const PillarRoom corridor = pcl6d::test::corridorWithClosets(random);
  DriftingRun run;
  std::vector<double> way;
  for (int i = 0; i < 4; ++i)
    way.push_back(-3 + i);
  for (int i = 0; i < 10; ++i)
    way.push_back(18 - 1.5 * i);
  for (const double x : way) {
    run.truth.push_back(pcl6d::test::poseInCorridor(x));
    run.odometry.push_back(movedBy(run.truth.size() > 4 ? -18 : 0) * run.truth.back());
    run.scans.push_back(pcl6d::test::shortSighted(corridor, run.truth.back(), random));
  }
  return run;
}
} // namespace

TEST(Recovery, FindsScansBehindAJumpOfTheOdometry)
{
  for (const double jump : {10.0, -3.0}) {
    SCOPED_TRACE(jump);
    const DriftingRun run = makeCorridorRun(14, 8, jump);
    const Slam6DResult result = registered(run);
    expectTruth(result, run);
    EXPECT_EQ(result.scans[7].recovered, RecoveredBy::kNone);
    EXPECT_NE(result.scans[8].recovered, RecoveredBy::kNone);
    EXPECT_EQ(result.scans[9].recovered, RecoveredBy::kNone);
    EXPECT_EQ(result.verification->trust, MapTrust::kGood);
    EXPECT_TRUE(result.trusted());
  }
}

TEST(Recovery, FindsScansBehindATurnOfTheOdometry)
{
  DriftingRun run = makeCorridorRun(12, 12, 0);
  for (std::size_t i = 6; i < run.odometry.size(); ++i)
    run.odometry[i] = run.odometry[5] * poseFromEuler({0, 0, 0}, {0, 0, 0.8}) *
                      run.truth[5].inverse() * run.truth[i];
  const Slam6DResult result = registered(run);
  expectTruth(result, run);
  EXPECT_NE(result.scans[6].recovered, RecoveredBy::kNone);
}

TEST(Recovery, IsLeftOutWhereNotWanted)
{
  Slam6DOptions options;
  options.recovery = RecoveryEffort::kOff;
  const Slam6DResult result = registered(makeCorridorRun(14, 8, 10), options);
  EXPECT_EQ(result.scans[8].recovered, RecoveredBy::kNone);
  EXPECT_GT(
      distanceBetween(makeCorridorRun(9, 8, 10).truth[8], result.scans[8].T_world_scan)
          .translation,
      5);
}

TEST(Recovery, LosesNothingBehindAScanOfElsewhere)
{
  DriftingRun run = makeCorridorRun(12, 12, 0);
  Random random(4);
  run.scans[6] = roomOfElsewhere().scan(Eigen::Isometry3d::Identity(), random, 0.03);
  run.odometry[6] = run.odometry[5];
  const Slam6DResult result = registered(run);
  expectTruth(result, run, {6});
  EXPECT_EQ(result.verification->trust, MapTrust::kDoubtful);
  EXPECT_FALSE(result.trusted());
}

TEST(Recovery, PiecesOfADriveThatWasCarriedAwayAreRightOrNotTrusted)
{
  const DriftingRun run = carriedAway();
  const Slam6DResult result = registered(run);
  bool is_right = true;
  for (std::size_t i = 0; i < run.truth.size(); ++i)
    is_right = is_right &&
               distanceBetween(run.truth[0].inverse() * run.truth[i],
                               result.scans[0].T_world_scan.inverse() *
                                   result.scans[i].T_world_scan)
                       .translation < kShareOfVoxel * result.parameters.voxel.value;
  EXPECT_TRUE(is_right || !result.trusted());
}

TEST(Recovery, PiecesWithoutAPlaceKeepTheirShapeBesideTheMap)
{
  DriftingRun run = makeCorridorRun(10, 10, 0);
  Random random(4);
  for (std::size_t i = 6; i < 10; ++i) {
    run.scans[i] = roomOfElsewhere().scan(
        poseFromEuler({0.3 * static_cast<double>(i) - 2, 0, 0}, {0, 0, 0.1}),
        random,
        0.03);
    run.odometry[i] = run.odometry[5] * movedBy(0.35 * static_cast<double>(i - 5));
  }
  const Slam6DResult result = registered(run);
  Slam6DResult map = result;
  map.scans.resize(6);
  run.truth.resize(6);
  expectTruth(map, run);
  EXPECT_FALSE(result.trusted());
  const auto& scans = result.scans;
  for (std::size_t i = 7; i < 10;
       ++i) { // of their own steps of 0.3 m, not the odometry's
    EXPECT_NEAR(
        distanceBetween(scans[i - 1].T_world_scan, scans[i].T_world_scan).translation,
        0.3,
        kShareOfVoxel * result.parameters.voxel.value)
        << i;
  }
  const auto& rejections = scans[6].rejections;
  const auto together =
      std::find_if(rejections.begin(), rejections.end(), [](const auto& one) {
        return one.reason == pcl6d::RejectReason::kLostTogether;
      });
  ASSERT_NE(together, rejections.end()) << toWords(rejections);
  EXPECT_EQ(together->measured, 3);
  EXPECT_EQ(result.floating, (std::vector<std::size_t>{7, 8, 9}));
}

TEST(Recovery, GivesTheSameBitsForAnyNumberOfThreads)
{
  const DriftingRun run = carriedAway();
  Slam6DOptions options;
  options.num_threads = 1;
  const Slam6DResult one = registered(run, options);
  options.num_threads = 8;
  expectSameBits(registered(run, options), one);
}

TEST(Recovery, CanBeCancelledAndGoesOn)
{
  DriftingRun run = makeCorridorRun(8, 8, 0);
  Random random(4);
  run.scans[4] = roomOfElsewhere().scan(Eigen::Isometry3d::Identity(), random, 0.03);
  Slam6D slam;
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    slam.addScan(run.scans[i], run.odometry[i]);
  bool is_asked = false;
  slam.setProgressCallback([&](const pcl6d::Progress& now) {
    if (now.stage == "recovering" && !is_asked) {
      is_asked = true;
      slam.cancel();
    }
  });
  EXPECT_FALSE(slam.optimize());
  ASSERT_TRUE(is_asked);
  EXPECT_TRUE(slam.optimize());
  expectSameBits(slam.result(), registered(run));
}

TEST(RepeatedMotion, IsOneAfterTheOther)
{
  const Eigen::Isometry3d motion = poseFromEuler({1, 0.2, 0}, {0, 0.1, 0.3});
  EXPECT_TRUE(pcl6d::slam6d::repeated(motion, 0).isApprox(Eigen::Isometry3d::Identity(),
                                                          1e-15));
  EXPECT_TRUE(
      pcl6d::slam6d::repeated(motion, 3).isApprox(motion * motion * motion, 1e-14));
}
