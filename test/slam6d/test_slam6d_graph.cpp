// SPDX-License-Identifier: BSD-3-Clause
#include "ring_run.h"
#include "room_scans.h"
#include "support/points.h"

using pcl6d::LinkKind;
using pcl6d::LinkVerdict;
using pcl6d::ScanLink;
using pcl6d::ScanState;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::StageResult;
using pcl6d::test::badArgumentOf;
using pcl6d::test::DriftingRun;
using pcl6d::test::pairwise;
using pcl6d::test::positionRms;
using pcl6d::test::registered;
using pcl6d::test::ring;
using pcl6d::test::sameBits;
using pcl6d::test::stageOf;

namespace {

const Slam6DResult&
relaxed()
{
  static const Slam6DResult result = registered(ring(), pairwise());
  return result;
}

Slam6DOptions
matchingOnly()
{
  Slam6DOptions options = pairwise();
  options.relaxation.reset();
  options.loop_closing = pcl6d::LoopClosing::kNone;
  return options;
}

const Slam6DResult&
matched()
{
  static const Slam6DResult result = registered(ring(), matchingOnly());
  return result;
}

const ScanLink*
linkOf(const Slam6DResult& result, std::size_t from, std::size_t to)
{
  for (const ScanLink& link : result.links)
    if (link.from == from && link.to == to && link.kind != LinkKind::kLoop)
      return &link;
  return nullptr;
}
} // namespace

TEST(Slam6DGraph, RelaxationBringsADriftedRingNearerToTheTruth)
{
  RecordProperty("rms_matched", std::to_string(positionRms(matched(), ring())));
  RecordProperty("rms_relaxed", std::to_string(positionRms(relaxed(), ring())));
  EXPECT_LT(positionRms(relaxed(), ring()), 0.6 * positionRms(matched(), ring()));
  ASSERT_GE(relaxed().stages.size(), 2u);
  EXPECT_EQ(relaxed().stages.front().kind, pcl6d::StageKind::kMatching);
  const StageResult& stage = relaxed().stages.back();
  EXPECT_EQ(stage.kind, pcl6d::StageKind::kRelaxation);
  EXPECT_FALSE(stage.reverted) << stage.rejection;
  EXPECT_FALSE(stage.rejection);
  EXPECT_GT(stage.rounds, 0);
  EXPECT_GT(stage.agreement_after, stage.agreement_before);
  EXPECT_LE(stage.agreement_after, 1);
  EXPECT_GT(relaxed().stages.front().agreement_after,
            relaxed().stages.front().agreement_before)
      << "matching against odometry";
}

TEST(Slam6DGraph, GivesLinksGraphAndCovariances)
{
  const Slam6DResult& result = relaxed();
  EXPECT_TRUE(result.floating.empty());
  ASSERT_EQ(result.graph.poses.size(), ring().scans.size());
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    EXPECT_TRUE(sameBits(result.graph.poses[i], result.scans[i].T_world_scan));
    EXPECT_TRUE(result.scans[i].covariance) << i;
  }
  std::size_t used = 0;
  for (const ScanLink& link : result.links) {
    used += link.verdict == LinkVerdict::kUsed && link.kind != LinkKind::kLoop;
    EXPECT_EQ(link.verdict == LinkVerdict::kUsed, !link.rejection) << link.rejection;
    EXPECT_LT(link.from, link.to);
  }
  EXPECT_EQ(result.graph.links.size(), used);
  EXPECT_GT(used, result.scans.size()) << "more than a chain";
  for (std::size_t i = 1; i < result.scans.size(); ++i) {
    const ScanLink* link = linkOf(result, i - 1, i);
    ASSERT_NE(link, nullptr);
    EXPECT_EQ(link->kind, LinkKind::kSequence);
  }
}

TEST(Slam6DGraph, WithoutItsStagesLeavesThePosesAsMatched)
{
  EXPECT_EQ(stageOf(matched(), "loop closing"), nullptr);
  EXPECT_EQ(stageOf(matched(), "relaxation"), nullptr);
  EXPECT_TRUE(matched().links.empty());
  EXPECT_TRUE(matched().graph.poses.empty());
  // The observer sees each pose as matched, before the graph is looked at.
  Slam6D slam(pairwise());
  std::vector<Eigen::Isometry3d> seen;
  slam.setObserver([&](std::size_t, const pcl6d::ScanResult& scan) {
    seen.push_back(scan.T_world_scan);
  });
  for (std::size_t i = 0; i < ring().scans.size(); ++i)
    slam.addScan(ring().scans[i], ring().odometry[i]);
  EXPECT_TRUE(slam.optimize());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_TRUE(sameBits(seen[i], matched().scans[i].T_world_scan)) << i;
    EXPECT_TRUE(sameBits(seen[i], relaxed().scans[i].matched_pose)) << i;
    EXPECT_TRUE(sameBits(seen[i], matched().scans[i].matched_pose)) << i;
  }
  pcl6d::test::expectSameBits(slam.result(), relaxed());
  EXPECT_FALSE(sameBits(seen[5], slam.result().scans[5].T_world_scan));
}

TEST(Slam6DGraph, AStageThatIsUndoneLeavesThePosesBitForBit)
{
  // Two scans have one link: no cycle, nothing to spread.
  const DriftingRun run = pcl6d::test::makeDriftingRun(2);
  const Slam6DResult with = registered(run, pairwise());
  const Slam6DResult without = registered(run, matchingOnly());
  const StageResult* stage = stageOf(with, "relaxation");
  ASSERT_NE(stage, nullptr);
  EXPECT_TRUE(stage->reverted);
  EXPECT_EQ(stage->rejection.reason, pcl6d::RejectReason::kNoCycle);
  pcl6d::test::expectSameBits(with, without);
}

TEST(Slam6DGraph, ARelaxationWithoutAClearGainIsReverted)
{
  // Each scan is matched with all scans before: little is left to gain.
  const DriftingRun run = pcl6d::test::makeDriftingRun(4);
  Slam6DOptions options = pairwise();
  options.metascan = Slam6DOptions().metascan;
  const Slam6DResult with = registered(run, options);
  const StageResult* stage = stageOf(with, "relaxation");
  ASSERT_NE(stage, nullptr);
  EXPECT_GT(stage->agreement_after, stage->agreement_before) << "within chance";
  EXPECT_TRUE(stage->reverted);
  EXPECT_EQ(stage->rejection.reason, pcl6d::RejectReason::kNoClearGain);
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    EXPECT_TRUE(sameBits(with.scans[i].T_world_scan, with.scans[i].matched_pose)) << i;
}

TEST(Slam6DGraph, AWrongGivenLinkHardlyMovesTheResult)
{
  // Around a thin wall: the first and the last scan see its two sides, 0.1 m apart,
  // which a link between both takes for one.
  const DriftingRun run = pcl6d::test::makeRunAroundWall(11);
  Slam6DOptions options = pairwise();
  const Slam6DResult good = registered(run, options);
  options.given_links = {{10, 0}};
  const Slam6DResult given = registered(run, options);
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    EXPECT_LT((given.scans[i].T_world_scan.translation() -
               good.scans[i].T_world_scan.translation())
                  .norm(),
              0.01)
        << i;
  const ScanLink* link = linkOf(given, 0, 10);
  ASSERT_NE(link, nullptr);
  EXPECT_EQ(link->kind, LinkKind::kGiven);
  EXPECT_GT(link->pairs, 20u) << "it has pairs to mislead with";
  EXPECT_EQ(link->verdict, LinkVerdict::kRefused) << link->weight;
}

TEST(Slam6DGraph, RefusesAGivenLinkToNoScan)
{
  Slam6DOptions options = pairwise();
  options.given_links = {{0, 99}};
  EXPECT_NE(badArgumentOf([&] { registered(ring(), options); }).find("99"),
            std::string::npos);
  options.given_links = {{1, 1}};
  EXPECT_NE(badArgumentOf([&] { registered(ring(), options); }).find("itself"),
            std::string::npos);
}

TEST(Slam6DGraph, JoinsAScanThatCannotBeMatchedByOdometry)
{
  DriftingRun run = ring();
  pcl6d::Random random(4);
  run.scans[6] = pcl6d::test::heap(random);
  const Slam6DResult result = registered(run, pairwise());
  ASSERT_EQ(result.scans[6].state, ScanState::kPredicted);
  EXPECT_TRUE(result.floating.empty());
  const double step = (run.truth[5].inverse() * run.truth[6]).translation().norm();
  EXPECT_LT(
      (result.scans[6].T_world_scan.translation() - run.truth[6].translation()).norm(),
      0.2 * step + 0.05);
  for (const ScanLink& link : result.links)
    if (link.from == 6 || link.to == 6) {
      EXPECT_EQ(link.verdict, LinkVerdict::kOdometry) << link.from << " " << link.to;
      EXPECT_EQ(link.to, link.from + 1);
    }
  ASSERT_NE(linkOf(result, 5, 6), nullptr);
  ASSERT_NE(linkOf(result, 6, 7), nullptr);
  const auto& saved = result.graph.links;
  EXPECT_EQ(std::count_if(saved.begin(),
                          saved.end(),
                          [](const pcl6d::PoseLink& link) {
                            return link.from == 6 || link.to == 6;
                          }),
            2)
      << "the saved graph holds together";
  EXPECT_LT(positionRms(result, run), positionRms(matched(), run));
}

TEST(Slam6DGraph, GivesTheSameBitsForAnyNumberOfThreads)
{
  for (const unsigned int threads : {1u, 2u, 8u}) {
    Slam6DOptions options = pairwise();
    options.num_threads = threads;
    const Slam6DResult result = registered(ring(), options);
    pcl6d::test::expectSameBits(result, relaxed());
    EXPECT_EQ(result.stages.back().agreement_after,
              relaxed().stages.back().agreement_after);
    ASSERT_EQ(result.links.size(), relaxed().links.size());
    for (std::size_t k = 0; k < result.links.size(); ++k)
      EXPECT_EQ(result.links[k].weight, relaxed().links[k].weight);
  }
}
