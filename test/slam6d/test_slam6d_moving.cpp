// SPDX-License-Identifier: BSD-3-Clause
// What moves while scans are taken: found, and left out.
#include "registered_run.h"
#include "support/walked_room.h"

#include <pcl6d/common/error.h>

#include <algorithm>
#include <string>
#include <vector>

using pcl6d::PointMotion;
using pcl6d::Points;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::StageKind;
using pcl6d::test::expectSameBits;
using pcl6d::test::makeWalkedRun;
using pcl6d::test::WalkedRun;

namespace {

const WalkedRun&
walkedRun()
{
  static const WalkedRun run = makeWalkedRun();
  return run;
}

Slam6D
optimized(const WalkedRun& run, const Slam6DOptions& options = {})
{
  Slam6D slam(options);
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    slam.addScan(run.scans[i], run.odometry[i]);
  EXPECT_TRUE(slam.optimize());
  return slam;
}

/** The largest distance [m] of a pose from the truth, the first scan being at its place. */
double
farthestOff(const Slam6D& slam, const WalkedRun& run)
{
  double farthest = 0;
  const auto& scans = slam.result().scans;
  for (std::size_t i = 0; i < scans.size(); ++i)
    farthest = std::max(
        farthest,
        (scans[i].T_world_scan.translation() - run.truth[i].translation()).norm());
  return farthest;
}

std::ptrdiff_t
numRelaxations(const Slam6D& slam)
{
  const auto& stages = slam.result().stages;
  return std::count_if(stages.begin(), stages.end(), [](const auto& stage) {
    return stage.kind == StageKind::kRelaxation;
  });
}
} // namespace

TEST(Slam6DMoving, FindsWhoWalksAndNothingElse)
{
  const Slam6D slam = optimized(walkedRun());
  ASSERT_TRUE(slam.result().moving);
  EXPECT_FALSE(slam.result().moving->blind);
  EXPECT_GT(slam.result().moving->moving, 100U);
  std::size_t body = 0, found = 0, rest = 0, eaten = 0;
  for (std::size_t i = 0; i < walkedRun().scans.size(); ++i) {
    const auto motion = slam.motionOf(i, walkedRun().scans[i]);
    ASSERT_EQ(motion.size(), walkedRun().scans[i].size());
    for (std::size_t p = 0; p < motion.size(); ++p) {
      const bool moved = motion[p] == PointMotion::kDynamic;
      body += walkedRun().walker[i][p] == 2 ? 1 : 0;
      found += walkedRun().walker[i][p] == 2 && moved ? 1 : 0;
      rest += walkedRun().walker[i][p] == 0 ? 1 : 0;
      eaten += walkedRun().walker[i][p] == 0 && moved ? 1 : 0;
    }
  }
  EXPECT_GT(body, 2000U) << "a test without a walker shows nothing";
  EXPECT_GE(found, body * 97 / 100);
  EXPECT_LE(eaten, rest * 3 / 1000);
}

TEST(Slam6DMoving, TakesNoPartInALastRoundOfRelaxation)
{
  const Slam6D slam = optimized(walkedRun());
  EXPECT_EQ(numRelaxations(slam), 2);
  EXPECT_EQ(slam.result().stages.back().rounds, 2);
  EXPECT_LT(farthestOff(slam, walkedRun()), 0.01);
  EXPECT_TRUE(slam.result().trusted());
}

TEST(Slam6DMoving, WhatPullsNoScanIsFoundWithoutRelaxingAgain)
{
  const WalkedRun bird =
      makeWalkedRun(0.3, 1); // far from all that it could be matched with
  const Slam6D slam = optimized(bird);
  EXPECT_GT(slam.result().moving->moving, 50U);
  EXPECT_EQ(numRelaxations(slam), 1);
  EXPECT_LT(farthestOff(slam, bird), 0.01);
}

TEST(Slam6DMoving, CancelledInTheLastRoundItGoesOnWithIt)
{
  const Slam6D whole = optimized(walkedRun());
  Slam6D slam;
  for (std::size_t i = 0; i < walkedRun().scans.size(); ++i)
    slam.addScan(walkedRun().scans[i], walkedRun().odometry[i]);
  bool is_cancelled = false;
  slam.setProgressCallback([&](const pcl6d::Progress& progress) {
    if (is_cancelled || progress.stage != "relaxing" || !slam.result().moving)
      return;
    is_cancelled = true;
    slam.cancel();
  });
  EXPECT_FALSE(slam.optimize());
  ASSERT_TRUE(is_cancelled);
  EXPECT_TRUE(slam.optimize());
  expectSameBits(slam.result(), whole.result());
}

TEST(Slam6DMoving, ChangesNothingWhereNothingMoves)
{
  const WalkedRun still = makeWalkedRun(0);
  Slam6DOptions nobody_asks;
  nobody_asks.leave_out_moving = false;
  const Slam6D asked = optimized(still);
  const Slam6D not_asked = optimized(still, nobody_asks);
  ASSERT_TRUE(asked.result().moving);
  EXPECT_LE(asked.result().moving->moving, asked.result().moving->evaluated / 1000);
  EXPECT_FALSE(not_asked.result().moving);
  expectSameBits(asked.result(), not_asked.result());
}

TEST(Slam6DMoving, IsTheSameForAnyNumberOfThreads)
{
  Slam6DOptions options;
  options.num_threads = 1;
  const Slam6D one = optimized(walkedRun(), options);
  const auto motion = one.motionOf(3, walkedRun().scans[3]);
  for (const unsigned int threads : {2U, 8U}) {
    options.num_threads = threads;
    const Slam6D several = optimized(walkedRun(), options);
    expectSameBits(one.result(), several.result());
    EXPECT_EQ(several.motionOf(3, walkedRun().scans[3]), motion);
  }
}

TEST(Slam6DMoving, IsJudgedAnewWhenScansAreAdded)
{
  Slam6D slam;
  const WalkedRun& run = walkedRun();
  for (std::size_t i = 0; i < 5; ++i)
    slam.addScan(run.scans[i], run.odometry[i]);
  ASSERT_TRUE(slam.optimize());
  const std::size_t before = slam.result().moving->moving;
  for (std::size_t i = 5; i < run.scans.size(); ++i)
    slam.addScan(run.scans[i], run.odometry[i]);
  ASSERT_TRUE(slam.optimize());
  EXPECT_GT(slam.result().moving->moving, before);
  EXPECT_LT(farthestOff(slam, run), 0.01);
}

TEST(Slam6DMoving, OneScanAloneIsKnownToNobody)
{
  Slam6D slam;
  slam.addScan(walkedRun().scans[0], walkedRun().odometry[0]);
  ASSERT_TRUE(slam.optimize());
  for (const PointMotion motion : slam.motionOf(0, walkedRun().scans[0]))
    EXPECT_NE(motion, PointMotion::kDynamic);
}

TEST(Slam6DMoving, RefusesWhatWasNotJudged)
{
  const Slam6D slam = optimized(walkedRun());
  EXPECT_THROW(slam.motionOf(8, Points{}), pcl6d::BadArgument);
  Slam6DOptions nobody_asks;
  nobody_asks.leave_out_moving = false;
  EXPECT_THROW(optimized(walkedRun(), nobody_asks).motionOf(0, Points{}),
               pcl6d::BadArgument);
}
