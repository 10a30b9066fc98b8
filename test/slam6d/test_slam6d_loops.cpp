// SPDX-License-Identifier: BSD-3-Clause
#include "ring_run.h"

#include <set>

using pcl6d::LinkKind;
using pcl6d::LinkVerdict;
using pcl6d::Progress;
using pcl6d::ScanLink;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::StageKind;
using pcl6d::StageResult;
using pcl6d::test::DriftingRun;
using pcl6d::test::expectSameBits;
using pcl6d::test::pairwise;
using pcl6d::test::positionRms;
using pcl6d::test::registered;

namespace {
/** Around a block: only at the end of the way the beginning comes in sight again. */
const DriftingRun&
block()
{
  static const DriftingRun run = pcl6d::test::makeRunAroundBlock(37);
  return run;
}

/** Options of a scanner that sees no farther than the next corner. */
Slam6DOptions
nearSighted()
{
  Slam6DOptions options = pairwise();
  options.max_range = 5;
  options.max_distance = 0.25;
  return options;
}

const Slam6DResult&
whole()
{
  static const Slam6DResult result = registered(block(), nearSighted());
  return result;
}

/** The scans as matched, before loops are closed. */
const Slam6DResult&
matched()
{
  static const Slam6DResult result = [] {
    Slam6DOptions options = nearSighted();
    options.relaxation.reset();
    options.loop_closing = pcl6d::LoopClosing::kNone;
    return registered(block(), options);
  }();
  return result;
}
} // namespace

TEST(Slam6DLoops, AreClosedBeforeRelaxing)
{
  ASSERT_EQ(whole().stages.size(), 3u);
  EXPECT_EQ(whole().stages[0].kind, StageKind::kMatching);
  EXPECT_EQ(whole().stages[1].kind, StageKind::kLoopClosing);
  EXPECT_EQ(whole().stages[2].kind, StageKind::kRelaxation);
  for (const StageResult& stage : whole().stages)
    EXPECT_FALSE(stage.undone) << toString(stage.kind) << ": " << stage.reason;
  EXPECT_LT(positionRms(whole(), block()), 0.7 * positionRms(matched(), block()));
}

TEST(Slam6DLoops, AreListedOnceWithTheirMatchedPose)
{
  std::set<pcl6d::ScanPair> seen;
  std::size_t loops = 0;
  for (const ScanLink& link : whole().links) {
    EXPECT_TRUE(seen.insert({link.from, link.to}).second)
        << link.from << " - " << link.to << " is listed twice";
    if (link.kind != LinkKind::kLoop)
      continue;
    ++loops;
    EXPECT_GE(link.to, link.from + 20);
    ASSERT_TRUE(link.T_from_to);
    if (link.verdict != LinkVerdict::kUsed)
      continue;
    const Eigen::Isometry3d T =
        block().truth[link.from].inverse() * block().truth[link.to];
    EXPECT_LT((link.T_from_to->translation() - T.translation()).norm(), 0.1);
  }
  EXPECT_GE(loops, 2u);
}

TEST(Slam6DLoops, ClosedBeforeACancelledRelaxationAreTakenBack)
{
  Slam6D slam(nearSighted());
  for (std::size_t i = 0; i < block().scans.size(); ++i)
    slam.addScan(block().scans[i], block().odometry[i]);
  slam.setProgressCallback([&slam, done = false](const Progress& p) mutable {
    if (p.stage == "relaxing" && !done) {
      done = true;
      slam.cancel();
    }
  });
  EXPECT_FALSE(slam.optimize());
  expectSameBits(slam.result(), matched());
  EXPECT_TRUE(slam.optimize());
  expectSameBits(slam.result(), whole());
}
