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
using pcl6d::test::sameBits;

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

/** The scans as matchedNearSighted, before loops are closed. */
const Slam6DResult&
matchedNearSighted()
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
  // The ends are 12 cm apart: closing them costs the scans around them more than it gains,
  // relaxation does it without.
  EXPECT_EQ(whole().stages[1].reverted, bool(whole().stages[1].rejection));
  EXPECT_FALSE(whole().stages[2].reverted) << whole().stages[2].rejection;
  EXPECT_LT(positionRms(whole(), block()),
            0.7 * positionRms(matchedNearSighted(), block()));
}

TEST(Slam6DLoops, AreListedOnceWithTheirMatchedPose)
{
  std::set<pcl6d::ScanPair> seen;
  std::size_t loops = 0;
  const double gap = whole().parameters.loop_gap.value;
  EXPECT_GE(gap, 10);
  for (const ScanLink& link : whole().links) {
    EXPECT_TRUE(seen.insert({link.from, link.to}).second)
        << link.from << " - " << link.to << " is listed twice";
    if (link.kind != LinkKind::kLoop)
      continue;
    ++loops;
    EXPECT_GE(link.to, link.from + static_cast<std::size_t>(gap));
    ASSERT_TRUE(link.T_from_to);
    if (link.verdict != LinkVerdict::kUsed)
      continue;
    const Eigen::Isometry3d T =
        block().truth[link.from].inverse() * block().truth[link.to];
    EXPECT_LT((link.T_from_to->translation() - T.translation()).norm(), 0.1);
  }
  EXPECT_GE(loops, 2u);
}

TEST(Slam6DLoops, AreClosedWhileScansAreMatchedIfAsked)
{
  Slam6DOptions options = nearSighted();
  options.relaxation.reset();
  options.close_loops_online = true;
  const Slam6DResult online = registered(block(), options);
  ASSERT_GE(online.stages.size(), 2u);
  std::size_t closed = 0;
  for (const StageResult& stage : online.stages)
    closed += stage.kind == StageKind::kLoopClosing && !stage.reverted ? 1 : 0;
  EXPECT_EQ(closed, 1u) << "what comes next sees the same loop";
  EXPECT_LT(positionRms(online, block()),
            0.95 * positionRms(matchedNearSighted(), block()));
  // Scans after the closing are matchedNearSighted against the corrected map.
  std::size_t first = block().scans.size();
  for (const ScanLink& link : online.links)
    if (link.verdict == LinkVerdict::kUsed)
      first = std::min(first, link.to);
  ASSERT_LT(first, block().scans.size() - 1);
  EXPECT_GT((online.scans.back().T_world_scan.translation() -
             matchedNearSighted().scans.back().T_world_scan.translation())
                .norm(),
            0.01);
  EXPECT_LT((online.scans.back().T_world_scan.translation() -
             block().truth.back().translation())
                .norm(),
            0.5 * (matchedNearSighted().scans.back().T_world_scan.translation() -
                   block().truth.back().translation())
                      .norm());
  options.num_threads = 1;
  expectSameBits(registered(block(), options), online);
}

TEST(Slam6DLoops, AreLeftOutByTheGate)
{
  Slam6DOptions options = nearSighted();
  options.relaxation.reset();
  options.loop_gate = 1e-9;
  for (const ScanLink& link : registered(block(), options).links)
    EXPECT_NE(link.kind, LinkKind::kLoop);
  options.loop_gate = 1e9;
  EXPECT_FALSE(registered(block(), options).links.empty());
}

TEST(Slam6DLoops, HaveParametersThatFollowFromTheScansOrAreGiven)
{
  const pcl6d::Slam6DParameters& derived = whole().parameters;
  EXPECT_NEAR(derived.link_distance.value, 1.5 * derived.loop_distance.value, 0.1);
  for (const pcl6d::Parameter& one : {derived.loop_distance,
                                      derived.loop_gap,
                                      derived.loop_pairs,
                                      derived.link_distance}) {
    EXPECT_FALSE(one.given);
    EXPECT_NE(one.why, "");
    EXPECT_GT(one.value, 0);
  }
  Slam6DOptions options = nearSighted();
  options.relaxation.reset();
  options.loop_distance = 0.5;
  options.loop_gap = 30;
  options.loop_pairs = 100;
  const Slam6DResult result = registered(block(), options);
  EXPECT_TRUE(result.parameters.loop_gap.given);
  for (const ScanLink& link : result.links) {
    EXPECT_GE(link.to, link.from + 30);
    EXPECT_LT(link.distance, 1.2); // half a metre sideways, twice as much up
  }
}

TEST(Slam6DLoops, AreSpreadScanByScanBySimultaneousMatching)
{
  Slam6DOptions options = nearSighted();
  options.relaxation.reset();
  options.simultaneous = true;
  const Slam6DResult result = registered(block(), options);
  ASSERT_FALSE(result.stages.empty());
  const StageResult& stage = result.stages.back();
  EXPECT_EQ(stage.kind, StageKind::kRelaxation);
  EXPECT_GT(stage.rounds, 0);
  EXPECT_FALSE(stage.reverted) << stage.rejection;
  EXPECT_GT(stage.agreement_after, stage.agreement_before - 0.01);
  EXPECT_LT(positionRms(result, block()),
            1.05 * positionRms(matchedNearSighted(), block()));
  EXPECT_FALSE(sameBits(result.scans[9].T_world_scan,
                        matchedNearSighted().scans[9].T_world_scan));
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
  expectSameBits(slam.result(), matchedNearSighted());
  EXPECT_TRUE(slam.optimize());
  expectSameBits(slam.result(), whole());
}
