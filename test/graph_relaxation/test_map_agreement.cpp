// SPDX-License-Identifier: BSD-3-Clause
#include "network_scans.h"
#include "support/points.h"

#include <pcl6d/graph_relaxation/map_agreement.h>
#include <pcl6d/graph_relaxation/stage_agreement.h>

using pcl6d::AgreementChange;
using pcl6d::compareStage;
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

/** The truth, with one scan moved; by default by 0.3 m. */
Poses
oneMoved(std::size_t scan, double share = 1)
{
  Poses poses = network().truth;
  poses[scan] = pcl6d::test::moved(poses[scan], share * Eigen::Vector3d(0.2, 0.2, 0.1));
  return poses;
}

StageAgreement
evaluated(const Poses& before, const Poses& after, unsigned int threads = 0)
{
  return compareStage(network().scans, before, after, kVoxel, threads);
}

void
expectSame(const AgreementChange& a, const AgreementChange& b)
{
  EXPECT_EQ(a.before, b.before);
  EXPECT_EQ(a.after, b.after);
  EXPECT_EQ(a.deviation, b.deviation);
}
} // namespace

TEST(AgreementOver, FallsWhenAScanIsMoved)
{
  const auto& scans = network().scans;
  const auto over = [&](const Poses& poses) {
    return pcl6d::agreementOver(
        pcl6d::visiblePairs(scans, poses, kVoxel), scans, poses, kVoxel);
  };
  const MapAgreement truth = over(network().truth), moved = over(oneMoved(2));
  EXPECT_GT(truth.total, 0.5);
  EXPECT_LE(truth.total, 1);
  EXPECT_LT(moved.total, truth.total - 0.05);
  for (std::size_t i = 0; i < 6; ++i)
    if (i != 2) {
      EXPECT_GT(moved.scans[i], moved.scans[2]);
    }
  EXPECT_EQ(pcl6d::agreementOver({}, scans, network().truth, kVoxel).total, 0);
  const std::string outside = badArgumentOf([&] {
    pcl6d::agreementOver({{0, 6}}, scans, network().truth, kVoxel);
  });
  EXPECT_NE(outside.find("scan of a pair = 6"), std::string::npos) << outside;
}

TEST(AgreementChange, IsALossBeyondChance)
{
  EXPECT_TRUE((AgreementChange{0.5, 0.46, 0.01}.isLoss()));
  EXPECT_FALSE((AgreementChange{0.5, 0.48, 0.01}.isLoss()));
  EXPECT_FALSE((AgreementChange{0.5, 0.46, 0.01}.isLoss(5)));
  EXPECT_TRUE((AgreementChange{0.5, 0.54, 0.01}.isGain()));
  EXPECT_FALSE((AgreementChange{0.5, 0.52, 0.01}.isGain()));
}

TEST(CompareStage, EqualPosesChangeNothing)
{
  const Poses& truth = network().truth;
  const StageAgreement stage = evaluated(truth, truth);
  EXPECT_EQ(stage.pairs, 15u) << "all see the same room";
  EXPECT_EQ(stage.total.before, stage.total.after);
  EXPECT_EQ(stage.total.deviation, 0);
  EXPECT_FALSE(stage.worse());
  EXPECT_GT(stage.total.before, 0.3);
  EXPECT_LE(stage.total.before, 1);
}

TEST(CompareStage, AMovedScanMakesTheMapWorseAndPuttingItBackMakesItBetter)
{
  const Poses& truth = network().truth;
  const StageAgreement worse = evaluated(truth, oneMoved(2));
  EXPECT_TRUE(worse.total.isLoss());
  EXPECT_EQ(worse.worse().reason, pcl6d::RejectReason::kAgreementLost) << worse.worse();
  EXPECT_GT(worse.worse().deviations, 3);
  for (std::size_t i = 0; i < 6; ++i)
    if (i != 2) {
      EXPECT_GT(worse.scans[i].after, worse.scans[2].after);
    }
  const StageAgreement better = evaluated(oneMoved(2), truth);
  EXPECT_FALSE(better.worse());
  EXPECT_TRUE(better.total.isGain());
  EXPECT_EQ(better.total.before, worse.total.after)
      << "the same points, both ways round";
  EXPECT_EQ(better.deviation, worse.deviation);
}

TEST(CompareStage, NoticesAShiftFarBelowTheVoxel)
{
  // 15 mm at a voxel of 0.3 m: no point loses its neighbour, walls are bent all the same.
  const Poses& truth = network().truth;
  EXPECT_TRUE(evaluated(truth, oneMoved(2, 0.05)).total.isLoss());
  EXPECT_TRUE(evaluated(oneMoved(2, 0.05), truth).total.isGain());
}

TEST(CompareStage, KnowsNoUnits)
{
  for (const double scale : {0.01, 100.0}) {
    const NetworkScans scaled = pcl6d::test::scaledBy(scale, network());
    const auto judgedThere = [&](Poses before, Poses after) {
      for (Poses* poses : {&before, &after})
        for (auto& pose : *poses)
          pose.translation() *= scale;
      return compareStage(scaled.scans, before, after, scale * kVoxel);
    };
    for (const double share : {0.01, 0.05, 1.0}) {
      const StageAgreement here = evaluated(network().truth, oneMoved(3, share));
      const StageAgreement there = judgedThere(network().truth, oneMoved(3, share));
      EXPECT_EQ(here.pairs, there.pairs);
      EXPECT_EQ(bool(here.worse()), bool(there.worse()));
      EXPECT_NEAR(here.total.before, there.total.before, 1e-3);
      EXPECT_NEAR(here.total.after, there.total.after, 1e-3);
      EXPECT_NEAR(here.deviation, there.deviation / scale, 0.01 * here.deviation);
    }
  }
}

TEST(CompareStage, NamesTheScanThatGotWorseWhileTheTotalDidNot)
{
  // Scan 1 is put right and scan 4 wrong by as much: what is lost by one is gained by
  // the other.
  StageAgreement stage = evaluated(oneMoved(1), oneMoved(4));
  stage.total.after = stage.total.before;
  EXPECT_EQ(stage.worse().reason, pcl6d::RejectReason::kScanAgreementLost)
      << stage.worse();
  EXPECT_EQ(stage.worse().text, "4");
  EXPECT_FALSE(stage.worse({true, true, true, true, false, true})) << "not counted";
  EXPECT_TRUE(stage.worse({false, false, false, false, true, false}));
}

TEST(StageAgreement, HasALimitForTheTotalAndAnotherForEachScan)
{
  const auto worse = [](double total, double scan, double deviation) {
    StageAgreement stage;
    stage.total = {0.5, total, 0.01};
    stage.scans = {{0.5, 0.5, 0.01}, {0.5, scan, deviation}};
    return stage.worse();
  };
  EXPECT_EQ(toWords(worse(0.48, 0.46, 0.01)), "");
  EXPECT_EQ(toWords(worse(0.46, 0.6, 0.01)),
            "agreement fell from 0.5 to 0.46, 4 standard deviations");
  EXPECT_EQ(toWords(worse(0.6, 0.44, 0.01)),
            "agreement of scan 1 fell from 0.5 to 0.44, 6 standard deviations");
  EXPECT_EQ(toWords(worse(0.6, 0.44, 0.02)), "") << "may be chance";
  EXPECT_EQ(toWords(worse(0.6, 0.46, 0.001)), "") << "beyond chance, but little";
}

TEST(CompareStage, LooksAtPairsThatSeeEachOtherBeforeOrAfter)
{
  // Torn apart, the scans share nothing; that must not hide the loss.
  Poses far = network().truth;
  far[5] = pcl6d::test::moved(far[5], {100, 0, 0});
  const StageAgreement stage = evaluated(network().truth, far);
  EXPECT_EQ(stage.pairs, 15u);
  const StageAgreement torn = evaluated(far, far);
  EXPECT_EQ(torn.pairs, 10u);
  EXPECT_EQ(torn.scans[5].before, 0) << "without pairs";
  EXPECT_TRUE(stage.worse());
}

TEST(CompareStage, BearsPosesBeyondAllNumbers)
{
  Poses lost = network().truth;
  lost[5].translation().setConstant(1e100);
  EXPECT_TRUE(evaluated(network().truth, lost).worse());
  lost[4].translation().setConstant(1e100); // and one beside it
  EXPECT_TRUE(evaluated(network().truth, lost).worse());
  EXPECT_EQ(compareStage({}, {}, {}, kVoxel).pairs, 0u);
}

TEST(CompareStage, RefusesOtherNumbersOfPoses)
{
  const Poses& truth = network().truth;
  const Poses fewer(truth.begin(), truth.end() - 1);
  EXPECT_NE(badArgumentOf([&] { evaluated(fewer, truth); }).find("poses before"),
            std::string::npos);
  EXPECT_NE(badArgumentOf([&] { evaluated(truth, fewer); }).find("poses after"),
            std::string::npos);
}

TEST(CompareStage, GivesTheSameNumbersForAnyNumberOfThreads)
{
  const StageAgreement one = evaluated(network().truth, oneMoved(3), 1);
  for (const unsigned int threads : {2u, 8u}) {
    const StageAgreement many = evaluated(network().truth, oneMoved(3), threads);
    EXPECT_EQ(many.pairs, one.pairs);
    EXPECT_EQ(many.deviation, one.deviation);
    expectSame(many.total, one.total);
    ASSERT_EQ(many.scans.size(), one.scans.size());
    for (std::size_t i = 0; i < one.scans.size(); ++i)
      expectSame(many.scans[i], one.scans[i]);
  }
}
