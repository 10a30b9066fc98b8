// SPDX-License-Identifier: BSD-3-Clause
#include "network_scans.h"
#include "support/points.h"

#include <pcl6d/graph_relaxation/map_agreement.h>

using pcl6d::judgeStage;
using pcl6d::MapAgreement;
using pcl6d::Poses;
using pcl6d::StageAgreement;
using pcl6d::test::badArgumentOf;
using pcl6d::test::NetworkScans;

namespace {
constexpr double kVoxel = 0.3; // [m] points agree within 12 cm

const NetworkScans&
network()
{
  static const NetworkScans scans =
      pcl6d::test::scansFrom(pcl6d::test::ringPoses(6), {}, 0.04);
  return scans;
}

/** The truth, with one scan moved by 0.3 m. */
Poses
oneMoved(std::size_t scan)
{
  Poses poses = network().truth;
  poses[scan] = pcl6d::test::moved(poses[scan], {0.2, 0.2, 0.1});
  return poses;
}

StageAgreement
judged(const Poses& before, const Poses& after, unsigned int threads = 0)
{
  return judgeStage(network().scans, before, after, kVoxel, threads);
}
} // namespace

TEST(JudgeStage, EqualPosesChangeNothing)
{
  const Poses& truth = network().truth;
  const StageAgreement stage = judged(truth, truth);
  EXPECT_EQ(stage.pairs, 15u) << "all see the same room";
  EXPECT_EQ(stage.before.total, stage.after.total);
  EXPECT_EQ(stage.before.scans, stage.after.scans);
  EXPECT_EQ(stage.worse(), "");
  EXPECT_GT(stage.before.total, 0.5);
  EXPECT_LE(stage.before.total, 1);
}

TEST(JudgeStage, AMovedScanMakesTheMapWorseAndPuttingItBackMakesItBetter)
{
  const Poses& truth = network().truth;
  const StageAgreement worse = judged(truth, oneMoved(2));
  EXPECT_LT(worse.after.total, worse.before.total - 0.05);
  EXPECT_EQ(worse.worse().find("agreement fell from "), 0u) << worse.worse();
  for (std::size_t i = 0; i < 6; ++i)
    if (i != 2) {
      EXPECT_GT(worse.after.scans[i], worse.after.scans[2]);
    }
  const StageAgreement better = judged(oneMoved(2), truth);
  EXPECT_EQ(better.worse(), "");
  EXPECT_EQ(better.before.total, worse.after.total)
      << "the same pairs, both ways round";
}

TEST(AgreementOver, IsTheHalfOfAStage)
{
  const Poses moved = oneMoved(2);
  const auto& scans = network().scans;
  const StageAgreement stage = judged(moved, moved);
  const auto pairs = pcl6d::visiblePairs(scans, moved, kVoxel);
  EXPECT_EQ(pairs.size(), stage.pairs);
  const MapAgreement agreement = pcl6d::agreementOver(pairs, scans, moved, kVoxel);
  EXPECT_EQ(agreement.total, stage.before.total);
  EXPECT_EQ(agreement.scans, stage.before.scans);
  EXPECT_EQ(pcl6d::agreementOver({}, scans, moved, kVoxel).total, 0);
  const std::string outside = badArgumentOf([&] {
    pcl6d::agreementOver({{0, 6}}, scans, moved, kVoxel);
  });
  EXPECT_NE(outside.find("scan of a pair = 6"), std::string::npos) << outside;
}

TEST(JudgeStage, NamesTheScanThatGotWorseWhileTheTotalDidNot)
{
  // Scan 1 is put right and scan 4 wrong by as much: what is lost by one is gained by
  // the other.
  StageAgreement stage = judged(oneMoved(1), oneMoved(4));
  stage.after.total = stage.before.total;
  EXPECT_EQ(stage.worse().find("agreement of scan 4 fell from "), 0u) << stage.worse();
  EXPECT_EQ(stage.worse({true, true, true, true, false, true}), "") << "not counted";
  EXPECT_NE(stage.worse({false, false, false, false, true, false}), "");
}

TEST(StageAgreement, HasALimitForTheTotalAndAnotherForEachScan)
{
  const auto worse = [](double total, double scan) {
    StageAgreement stage;
    stage.before = {0.5, {0.5, 0.5}};
    stage.after = {total, {0.5, scan}};
    return stage.worse();
  };
  EXPECT_EQ(worse(0.496, 0.46), "");
  EXPECT_EQ(worse(0.494, 0.6), "agreement fell from 0.5 to 0.494");
  EXPECT_EQ(worse(0.6, 0.44), "agreement of scan 1 fell from 0.5 to 0.44");
}

TEST(JudgeStage, LooksAtPairsThatSeeEachOtherBeforeOrAfter)
{
  // Torn apart, the scans share nothing; that must not hide the loss.
  Poses far = network().truth;
  far[5] = pcl6d::test::moved(far[5], {100, 0, 0});
  const StageAgreement stage = judged(network().truth, far);
  EXPECT_EQ(stage.pairs, 15u);
  EXPECT_EQ(judged(far, far).pairs, 10u);
  EXPECT_EQ(judged(far, far).before.scans[5], 0) << "without pairs";
  EXPECT_NE(stage.worse(), "");
}

TEST(JudgeStage, RefusesOtherNumbersOfPoses)
{
  const Poses& truth = network().truth;
  const Poses fewer(truth.begin(), truth.end() - 1);
  EXPECT_NE(badArgumentOf([&] { judged(fewer, truth); }).find("poses before"),
            std::string::npos);
  EXPECT_NE(badArgumentOf([&] { judged(truth, fewer); }).find("poses after"),
            std::string::npos);
}

TEST(JudgeStage, GivesTheSameNumbersForAnyNumberOfThreads)
{
  const StageAgreement one = judged(network().truth, oneMoved(3), 1);
  for (const unsigned int threads : {2u, 8u}) {
    const StageAgreement many = judged(network().truth, oneMoved(3), threads);
    EXPECT_EQ(many.pairs, one.pairs);
    EXPECT_EQ(many.before.total, one.before.total);
    EXPECT_EQ(many.after.total, one.after.total);
    EXPECT_EQ(many.before.scans, one.before.scans);
    EXPECT_EQ(many.after.scans, one.after.scans);
  }
}
