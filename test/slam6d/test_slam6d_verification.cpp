// SPDX-License-Identifier: BSD-3-Clause
// What Slam6D says of the map that it made, and the change of agreement.
#include "corridor_drive.h"
#include "matching/agreement.h"
#include "registered_run.h"
#include "support/constants.h"
#include "support/loose_scans.h"
#include "support/points.h"

#include <cmath>
#include <set>
#include <string>
#include <vector>

using pcl6d::AgreementChange;
using pcl6d::IcpModel;
using pcl6d::MapTrust;
using pcl6d::MapVerification;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::RecoveryEffort;
using pcl6d::ScanState;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::slam6d::agreementChange;
using pcl6d::slam6d::MeasuredScan;
using pcl6d::test::DriftingRun;
using pcl6d::test::kIdentity;
using pcl6d::test::kNan;
using pcl6d::test::looseOf;
using pcl6d::test::makeCorridorRun;
using pcl6d::test::makeDriftingRun;
using pcl6d::test::movedBy;
using pcl6d::test::PillarRoom;
using pcl6d::test::registered;

namespace {
constexpr double kNear = 0.1; // [m]

/** Scans that are lost stay so. */
pcl6d::Slam6DOptions
notRecovering()
{
  pcl6d::Slam6DOptions options;
  options.recovery = RecoveryEffort::kOff;
  return options;
}

/** \return the run in a world so many times as large */
DriftingRun
scaled(DriftingRun run, double scale)
{
  for (auto& scan : run.scans)
    for (auto& p : scan)
      p = (scale * p.cast<double>()).cast<float>();
  for (auto* poses : {&run.truth, &run.odometry})
    for (auto& pose : *poses)
      pose.translation() *= scale;
  return run;
}
} // namespace

TEST(AgreementChange, IsThePairedChangeWithADeviationByCubes)
{
  // Three points come to lie on the target, two of them in one cube; one leaves it.
  const IcpModel target(Points{{0, 0, 0}, {5, 0, 0}, {10, 0, 0}}, {});
  const Points points = {{-1, 0.01F, 0}, // at 0 after the motion, cube A
                         {-1, 0.02F, 0}, // the same
                         {4, 0, 0.03F},  // at 5, cube B
                         {5, 0, 0},      // at 6 after, at 5 before: cube C
                         {20, 0, 0},     // never, cube D
                         {kNan, 0, 0}};  // does not count
  const AgreementChange change = agreementChange(
      {target.part()}, points, kIdentity, movedBy(1), kNear, /*cube=*/0.5, 1);
  EXPECT_EQ(change.before, 1.0 / 5);
  EXPECT_EQ(change.after, 3.0 / 5);
  // Gains less the mean of 2/5: A 2 - 4/5, B 1 - 2/5, C -1 - 2/5, D -2/5.
  const double squares = 1.2 * 1.2 + 0.6 * 0.6 + 1.4 * 1.4 + 0.4 * 0.4;
  EXPECT_NEAR(change.deviation, std::sqrt(squares) / 5, 1e-15);
  EXPECT_FALSE(change.isGain()) << "5 points say little";
}

TEST(AgreementChange, CountsPointsOfACubeAsOne)
{
  // All points gain or lose by cubes of 1 m: twice the points are no more evidence.
  const auto deviationWith = [](int points_per_cube, double cube) {
    Points target, points;
    for (int i = 0; i < 40; ++i) {
      target.emplace_back(static_cast<float>(10 * i + (i % 2)), 0.0F, 0.0F);
      for (int k = 0; k < points_per_cube; ++k)
        points.emplace_back(static_cast<float>(10 * i) + 1e-3F,
                            1e-3F * static_cast<float>(k + 1),
                            0.0F);
    }
    const IcpModel model(target, {});
    return agreementChange(
               {model.part()}, points, kIdentity, movedBy(1), kNear, cube, 1)
        .deviation;
  };
  EXPECT_NEAR(deviationWith(1, 1), std::sqrt(40.0) / 40, 1e-12);
  EXPECT_NEAR(deviationWith(20, 1), deviationWith(1, 1), 1e-12);
  EXPECT_LT(deviationWith(20, 1e-3), 0.3 * deviationWith(1, 1))
      << "cubes of a point each";
}

TEST(AgreementChange, OfEqualPosesIsNone)
{
  Random random(1);
  const Points cube = pcl6d::test::randomCube(random, 3000, 5);
  const IcpModel model(cube, {});
  const AgreementChange change =
      agreementChange({model.part()}, cube, movedBy(0.1), movedBy(0.1), kNear, 0.5, 1);
  EXPECT_EQ(change.after, change.before);
  EXPECT_EQ(change.deviation, 0);
  EXPECT_FALSE(change.isLoss());
  EXPECT_FALSE(change.isGain());
}

TEST(AgreementChange, OfNothingIsNone)
{
  const IcpModel model(Points{{0, 0, 0}}, {});
  for (const Points& points : {Points(), Points{{kNan, 0, 0}}}) {
    const AgreementChange change =
        agreementChange({model.part()}, points, kIdentity, movedBy(1), kNear, 0.5, 1);
    EXPECT_EQ(change.before, 0);
    EXPECT_EQ(change.after, 0);
    EXPECT_EQ(change.deviation, 0);
  }
}

TEST(AgreementChange, IsALossOrAGainBeyondThreeDeviations)
{
  EXPECT_TRUE((AgreementChange{0.5, 0.469, 0.01}).isLoss());
  EXPECT_FALSE((AgreementChange{0.5, 0.471, 0.01}).isLoss());
  EXPECT_TRUE((AgreementChange{0.5, 0.531, 0.01}).isGain());
  EXPECT_FALSE((AgreementChange{0.5, 0.529, 0.01}).isGain());
}

TEST(AgreementChange, BothWaysIsTheOppositeFromTheOtherPose)
{
  Random random(2);
  const PillarRoom room;
  const MeasuredScan a(room.scan(kIdentity, random)), b(room.scan(movedBy(1), random));
  const auto change = [&](double before, double after, unsigned int threads = 1) {
    return agreementChange(a, b, movedBy(before), movedBy(after), kNear, 0.5, threads);
  };
  const AgreementChange better = change(1.3, 1), worse = change(1, 1.3);
  EXPECT_TRUE(better.isGain());
  EXPECT_TRUE(worse.isLoss());
  EXPECT_EQ(better.before, worse.after);
  EXPECT_EQ(better.after, worse.before);
  EXPECT_NEAR(better.deviation, worse.deviation, 1e-15);
  for (const unsigned int threads : {2u, 8u}) {
    const AgreementChange same = change(1.3, 1, threads);
    EXPECT_EQ(same.before, better.before);
    EXPECT_EQ(same.after, better.after);
    EXPECT_EQ(same.deviation, better.deviation);
  }
}

TEST(Slam6DVerification, OfAGoodRunIsGood)
{
  const Slam6DResult result = registered(makeDriftingRun(6));
  ASSERT_TRUE(result.verification);
  EXPECT_EQ(result.verification->trust, MapTrust::kGood)
      << result.verification->doubts.size();
  EXPECT_EQ(result.verification->scans.size(), 6u);
  EXPECT_GE(result.verification->links.size(), 5u);
  EXPECT_TRUE(result.trusted());
}

TEST(Slam6DVerification, IsMadeOnlyIfItIsAskedFor)
{
  Slam6DOptions options;
  options.verify = false;
  const DriftingRun run = makeDriftingRun(3);
  EXPECT_FALSE(registered(run, options).verification);
  EXPECT_TRUE(registered(run).verification);
}

TEST(Slam6DVerification, ChangesNoPose)
{
  Slam6DOptions options;
  options.verify = false;
  const DriftingRun run = makeDriftingRun(4);
  pcl6d::test::expectSameBits(registered(run), registered(run, options));
}

TEST(Slam6DVerification, WorksWithEveryMetric)
{
  const DriftingRun run = makeDriftingRun(4);
  for (const std::string& name : pcl6d::metricNames()) {
    Slam6DOptions options;
    options.metric = pcl6d::metricFromName(name);
    const Slam6DResult result = registered(run, options);
    ASSERT_TRUE(result.verification) << name;
    EXPECT_EQ(result.verification->trust, MapTrust::kGood) << name;
  }
}

TEST(Slam6DVerification, HasTheSameBitsForAnyNumberOfThreads)
{
  const DriftingRun run = makeDriftingRun(4);
  Slam6DOptions options;
  options.num_threads = 1;
  const Slam6DResult expected = registered(run, options);
  for (const unsigned int threads : {2u, 8u}) {
    options.num_threads = threads;
    const Slam6DResult found = registered(run, options);
    ASSERT_EQ(found.verification->links.size(), expected.verification->links.size());
    EXPECT_EQ(found.verification->background, expected.verification->background);
    for (std::size_t k = 0; k < found.verification->links.size(); ++k) {
      const auto &a = found.verification->links[k],
                 &b = expected.verification->links[k];
      EXPECT_EQ(a.probability_wrong, b.probability_wrong);
      EXPECT_EQ(a.shift, b.shift);
      EXPECT_EQ(a.deviation, b.deviation);
    }
  }
}

TEST(Slam6DVerification, OfOneScanIsUnverifiedAndTrusted)
{
  const Slam6DResult result = registered(makeDriftingRun(1));
  EXPECT_EQ(result.verification->trust, MapTrust::kUnverified);
  EXPECT_TRUE(result.trusted());
}

TEST(Slam6DVerification, OfADoubtfulMapIsNotTrusted)
{
  Slam6DResult result = registered(makeDriftingRun(3));
  ASSERT_TRUE(result.trusted());
  for (const MapTrust trust : {MapTrust::kDoubtful, MapTrust::kAmbiguous}) {
    result.verification->trust = trust;
    EXPECT_FALSE(result.trusted());
    EXPECT_FALSE(pcl6d::runResultOf(result, {"a", "b", "c"}, {0, 1, 2}).trusted);
  }
  const auto run = pcl6d::runResultOf(result, {"a", "b", "c"}, {0, 2, 4});
  ASSERT_TRUE(run.verification);
  EXPECT_EQ(run.verification->scans.size(), 3u);
}

TEST(Slam6DVerification, OfACorridorIsGood)
{
  const Slam6DResult result = registered(makeCorridorRun(14, 14, 0));
  EXPECT_EQ(result.verification->trust, MapTrust::kGood)
      << toWords(result.verification->doubts);
}

TEST(Slam6DVerification, NamesAllScansBehindAJumpOfTheOdometry)
{
  const Slam6DResult result = registered(makeCorridorRun(14, 8, 10), notRecovering());
  ASSERT_GT(
      (result.scans[8].T_world_scan.translation() - Eigen::Vector3d(8, 0, 0)).norm(), 5)
      << "it was recovered";
  EXPECT_EQ(result.verification->trust, MapTrust::kDoubtful);
  EXPECT_FALSE(result.trusted());
  std::set<std::size_t> expected = {8, 9, 10, 11, 12, 13};
  // Scans that were not matched are not connected either.
  for (std::size_t i = 0; i < 8; ++i)
    if (result.scans[i].state == ScanState::kPredicted)
      expected.insert(i);
  EXPECT_LT(expected.size(), 8u);
  EXPECT_EQ(looseOf(*result.verification), expected);
  const pcl6d::Rejection& doubt = result.verification->doubts.at(0);
  EXPECT_EQ(doubt.reason, pcl6d::RejectReason::kScansDisconnected);
  EXPECT_EQ(doubt.measured, static_cast<double>(expected.size())) << doubt;
  EXPECT_NE(doubt.text.find("scan 8, "), std::string::npos) << doubt;
}

TEST(Slam6DVerification, NamesFilesWithoutTheirFolders)
{
  const DriftingRun run = makeDriftingRun(2);
  pcl6d::Slam6D slam(notRecovering());
  slam.addScan(run.scans[0], run.odometry[0], "/some/where/a.pcd");
  slam.addScan(run.scans[1],
               Eigen::Translation3d(100, 0, 0) * run.odometry[1],
               "/some/where/b.pcd");
  EXPECT_TRUE(slam.optimize());
  const MapVerification& map = *slam.result().verification;
  ASSERT_FALSE(map.doubts.empty());
  EXPECT_EQ(toWords(map.doubts[0])
                .find("1 scan not connected to the rest: b.pcd (with a.pcd: "),
            0u)
      << map.doubts[0];
}

TEST(Slam6DVerification, SaysTheSameOfAWorldAHundredTimesAsLargeOrSmall)
{
  // Matching and verdict: what of them is a length scales with the world, the rest stays.
  for (const auto& [run, is_right] : {std::pair{makeDriftingRun(6), true},
                                      std::pair{makeCorridorRun(12, 6, 9), false}}) {
    const Slam6DResult usual = registered(run, notRecovering());
    ASSERT_EQ(usual.trusted(), is_right);
    for (const double scale : {100.0, 0.01}) {
      SCOPED_TRACE(scale);
      const Slam6DResult other = registered(scaled(run, scale), notRecovering());
      EXPECT_EQ(other.trusted(), is_right);
      EXPECT_EQ(other.verification->trust, usual.verification->trust);
      EXPECT_EQ(looseOf(*other.verification), looseOf(*usual.verification));
      for (std::size_t i = 0; i < run.scans.size(); ++i) { // epsilons are metres
        EXPECT_LT((other.scans[i].T_world_scan.translation() / scale -
                   usual.scans[i].T_world_scan.translation())
                      .norm(),
                  kNear)
            << i;
      }
    }
  }
}
