// SPDX-License-Identifier: BSD-3-Clause
// What recovery may cost: a bounded search ends where its time does, and nothing is searched where
// nothing can be found.
#include "any_order/kept_pieces.h"
#include "corridor_drive.h"
#include "recovery/recovery.h"
#include "recovery/second_look.h"
#include "support/constants.h"

#include <pcl6d/slam6d/slam6d.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

using pcl6d::BadArgument;
using pcl6d::poseFromEuler;
using pcl6d::Progress;
using pcl6d::Random;
using pcl6d::RecoveryEffort;
using pcl6d::ScanResult;
using pcl6d::ScanState;
using pcl6d::Slam6D;
using pcl6d::Slam6DOptions;
using pcl6d::Slam6DResult;
using pcl6d::test::DriftingRun;
using pcl6d::test::makeCorridorRun;
using pcl6d::test::movedBy;

TEST(Recovery, OfAPieceOnlySomeScansAreComparedWithOthers)
{
  using pcl6d::slam6d::KnownPlaces;
  EXPECT_TRUE(pcl6d::slam6d::pairsBesidePieces(KnownPlaces(10)).empty());
  KnownPlaces pieces(12); // scans 0 to 2 and 10 are in none
  for (std::size_t i = 3; i < 10; ++i)
    pieces[i] = pcl6d::KnownPlace{1, pcl6d::test::kIdentity};
  pieces[11] = pcl6d::KnownPlace{2, pcl6d::test::kIdentity};
  const auto pairs = pcl6d::slam6d::pairsBesidePieces(pieces);
  std::set<std::size_t> compared;
  for (const auto& [first, second] : pairs) {
    EXPECT_LT(first, second);
    compared.insert({first, second});
  }
  EXPECT_EQ(compared, (std::set<std::size_t>{0, 1, 2, 3, 5, 7, 9, 10, 11}));
  EXPECT_EQ(pairs.size(), 36U); // each of nine with each other
}

TEST(Recovery, EffortsHaveWords)
{
  for (const std::string& word : pcl6d::recoveryEffortNames())
    EXPECT_EQ(toString(pcl6d::recoveryEffortFromName(word)), word);
  EXPECT_EQ(pcl6d::recoveryEffortNames().size(), 3u);
  EXPECT_THROW(pcl6d::recoveryEffortFromName("everywhere"), BadArgument);
  EXPECT_EQ(Slam6DOptions().recovery, RecoveryEffort::kBounded);
}

TEST(Recovery, BoundedComparesFourScansOfAPiece)
{
  DriftingRun run = makeCorridorRun(6, 6, 0);
  Random random(4);
  for (int i = 0; i < 6; ++i) { // a piece of another room, 0.3 m apart
    run.scans.push_back(pcl6d::test::roomOfElsewhere().scan(
        poseFromEuler({0.3 * i - 0.2, 0, 0}, {0, 0, 0.1}), random, 0.03));
    run.odometry.push_back(run.odometry.back() * movedBy(0.35));
  }
  const auto comparedBy = [&](RecoveryEffort effort) {
    Slam6DOptions options;
    options.recovery = effort;
    std::size_t most = 0; // all scans, or all pairs
    Slam6D slam(options);
    slam.setProgressCallback([&](const Progress& now) {
      if (now.stage == "recovering")
        most = std::max(most, now.total);
    });
    for (std::size_t i = 0; i < run.scans.size(); ++i)
      slam.addScan(run.scans[i], run.odometry[i]);
    EXPECT_TRUE(slam.optimize());
    // the first scan of the piece, and those that match it, beside the map
    EXPECT_EQ(slam.result().count(ScanState::kPredicted), 1u);
    EXPECT_EQ(slam.result().floating.size(), 5u);
    return most;
  };
  EXPECT_EQ(comparedBy(RecoveryEffort::kBounded), 4u * 6u);
  EXPECT_EQ(comparedBy(RecoveryEffort::kThorough), 6u * 6u);
}

TEST(Recovery, BoundedDoesNotSearchFarWhereRaysConfirmNoLinkAtAll)
{
  using pcl6d::slam6d::isLongSearchUseful;
  using pcl6d::slam6d::RayTest;
  using pcl6d::slam6d::RejectedMatch;
  RejectedMatch as_others;
  as_others.is_unconfirmed = as_others.is_expected = true;
  as_others.rays = RayTest::kFailed;
  EXPECT_FALSE(isLongSearchUseful(as_others, RecoveryEffort::kBounded));
  EXPECT_TRUE(isLongSearchUseful(as_others, RecoveryEffort::kThorough));
  std::vector<RejectedMatch> others(5, as_others);
  others[0].is_unconfirmed = false; // not matched at all
  others[1].is_contradicted = true;
  others[2].is_expected = false;
  others[3].rays = RayTest::kUnproven;
  others[4].rays = RayTest::kConfirming;
  for (const RejectedMatch& other : others)
    EXPECT_TRUE(isLongSearchUseful(other, RecoveryEffort::kBounded));
}

TEST(Recovery, BoundedSearchesFailNoMoreOftenThanMatchingPaysFor)
{
  // Hopeless odometry: a few scans are matched, all others are lost, one by one or in a row.
  for (const std::size_t every : {2U, 200U})
    for (const bool is_bounded : {true, false}) {
      std::vector<ScanResult> scans(200);
      std::size_t searches = 0, matched = 0;
      for (std::size_t i = 0; i < scans.size(); ++i) {
        scans[i].state = i % every == 0 ? ScanState::kMatched : ScanState::kPredicted;
        matched += i % every == 0 ? 1 : 0;
        searches += i % every != 0 && pcl6d::slam6d::isSearchDue(i, scans, is_bounded);
      }
      if (is_bounded) // a search takes the time of 24 matches; two are always allowed
        EXPECT_LE(searches, std::max<std::size_t>(2, matched / 24)) << every;
      else // of 199 in a row: the first, second, fourth, ...
        EXPECT_EQ(searches, every == 2 ? 100U : 8U);
    }
}

TEST(Recovery, ComparesNoScansWhereNoneWasLost)
{
  const DriftingRun run = makeCorridorRun(16, 16, 0);
  Slam6D slam;
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    slam.addScan(run.scans[i], run.odometry[i]);
  slam.setProgressCallback([](const Progress& now) {
    EXPECT_NE(now.stage, "recovering") << now.done << " of " << now.total;
  });
  EXPECT_TRUE(slam.optimize());
  EXPECT_EQ(slam.result().count(ScanState::kPredicted), 0u);
}

// Of 100 scans of a corridor with odometry all were matched, but links connected few: a second
// look compared 4751 pairs.
TEST(Recovery, BoundedRegistersAMapThatIsMostlyDisconnectedNoSecondTime)
{
  for (const std::size_t connected : {9U, 3U}) {
    Slam6DResult result;
    result.scans.resize(10);
    result.verification.emplace();
    result.verification->scans.resize(10);
    for (std::size_t i = 0; i < 10; ++i) {
      result.scans[i].state = ScanState::kMatched;
      result.verification->scans[i].tied = i < connected;
    }
    EXPECT_EQ(pcl6d::slam6d::isMostlyDisconnected(0, result), connected == 3);
  }
}

TEST(Recovery, ScansWithAMotionLeftOpenAreNotDisconnected)
{
  // Surfaces leave a motion open, and the given poses, or a tracked step, fix it: no link connects
  // such a scan, and a search would not either.
  pcl6d::Slam6DResult result;
  result.scans.resize(10);
  result.verification.emplace();
  result.verification->scans.resize(10);
  result.verification->scans[0].tied = true;
  result.scans[0].state = ScanState::kFixed;
  for (const ScanState state : {ScanState::kUnconverged, ScanState::kMatched}) {
    for (std::size_t i = 1; i < 10; ++i) {
      result.scans[i].state = state;
      result.scans[i].status = pcl6d::Status::kRankDeficient;
    }
    EXPECT_FALSE(pcl6d::slam6d::isMostlyDisconnected(0, result));
  }
  for (std::size_t i = 1; i < 10; ++i)
    result.scans[i].status = pcl6d::Status::kOk;
  EXPECT_TRUE(pcl6d::slam6d::isMostlyDisconnected(0, result));
}

TEST(Recovery, DoesNotSearchForAScanThatNoLinkCanConfirm)
{
  DriftingRun run = makeCorridorRun(8, 8, 0);
  Random random(4);
  run.scans[4].clear(); // no surface
  for (int i = 0; i < 80; ++i)
    run.scans[4].push_back(Eigen::Vector3f(
        random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(-6, 6)));
  Slam6D slam;
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    slam.addScan(run.scans[i], run.odometry[i]);
  slam.setProgressCallback([&](const Progress& now) { // scans, but no pairs
    EXPECT_TRUE(now.stage != "recovering" || now.total == run.scans.size())
        << now.total;
  });
  EXPECT_TRUE(slam.optimize());
  EXPECT_EQ(slam.result().count(ScanState::kPredicted), 1u);
  const std::string why = toWords(slam.result().scans[4].rejections);
  EXPECT_NE(why.find("in the map: a scan has too few surfaces"), std::string::npos)
      << why;
}
