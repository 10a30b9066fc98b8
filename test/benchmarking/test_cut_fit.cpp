// SPDX-License-Identifier: BSD-3-Clause
// Constants of cuts, fitted to all sensors except one.

#include "../benchmark/cut_fit.h"

#include <gtest/gtest.h>

#include <sstream>

using pcl6d::LinkCheck;
using pcl6d::LinkTrust;
using pcl6d::TrustCall;
using pcl6d::bench::CutCounts;
using pcl6d::bench::CutFit;
using pcl6d::bench::CutRun;
using pcl6d::bench::CutVerdict;

namespace {
/** Two triangles of scans, 0 1 2 and 3 4 5, each scan 1 m from the one before, with a link between
 * both. */
CutRun
triangles(const std::string& sensor, std::size_t contradicted)
{
  CutRun run;
  run.sensor = sensor;
  run.result.verification.emplace();
  run.result.verification->background = 0.002;
  run.result.verification->trust = pcl6d::MapTrust::kGood;
  run.result.verification->scans.resize(6);
  for (int i = 0; i < 6; ++i) {
    pcl6d::ScanResult scan;
    scan.index = 10 + i; // as in names of files
    scan.state = i == 0 ? pcl6d::ScanState::kFixed : pcl6d::ScanState::kMatched;
    scan.T_world_scan.translation().x() = i;
    run.result.scans.push_back(scan);
    run.result.verification->scans[static_cast<std::size_t>(i)].tied = true;
  }
  run.truth.resize(16, Eigen::Isometry3d::Identity());
  for (std::size_t i = 0; i < 6; ++i)
    run.truth[10 + i] = run.result.scans[i].T_world_scan;
  const std::size_t ends[][2] = {
      {0, 1}, {1, 2}, {0, 2}, {3, 4}, {4, 5}, {3, 5}, {2, 3}};
  for (const auto& [from, to] : ends) {
    LinkCheck link;
    link.from = 10 + from;
    link.to = 10 + to;
    link.trust = LinkTrust::kGood;
    link.patches = from == 2 ? 98 : 300;
    link.contradicted = from == 2 ? contradicted : 0;
    run.links.push_back(link);
  }
  run.links = pcl6d::bench::linksBeforeCuts(run.links, run.result.scans);
  return run;
}

/** The second triangle lies at a wrong place. */
CutRun
displaced(CutRun run)
{
  for (std::size_t i = 3; i < 6; ++i)
    run.result.scans[i].T_world_scan.translation().y() += 4;
  return run;
}

CutVerdict
verdictOf(const CutRun& run)
{
  return pcl6d::bench::verdictWith(pcl6d::verification::cutConstants(), run);
}
} // namespace

TEST(CutRuns, AreReadAsTheyWereBeforeTheCut)
{
  std::vector<pcl6d::ScanResult> scans(2);
  scans[0].index = 3;
  scans[1].index = 6;
  for (auto& scan : scans)
    scan.state = pcl6d::ScanState::kMatched;
  std::vector<LinkCheck> links(2);
  for (LinkCheck& link : links) {
    link.from = 3;
    link.to = 6;
    link.trust = LinkTrust::kWeak;
  }
  links[0].rejection = pcl6d::Rejection::stated(
      pcl6d::toWords({pcl6d::RejectReason::kInconsistentTogether, 5, 731}));
  links[1].rejection = pcl6d::Rejection::stated(
      pcl6d::toWords({pcl6d::RejectReason::kPatchesViolated, 5, 731}));
  links = pcl6d::bench::linksBeforeCuts(links, scans);
  EXPECT_EQ(links[0].from, 0U);
  EXPECT_EQ(links[0].to, 1U);
  EXPECT_EQ(links[0].trust, LinkTrust::kGood);
  EXPECT_EQ(links[1].trust, LinkTrust::kWeak);
  scans[1].state = pcl6d::ScanState::kPredicted;
  for (LinkCheck& link : links) {
    link.from = 3;
    link.to = 6;
  }
  EXPECT_EQ(pcl6d::bench::linksBeforeCuts(links, scans)[0].trust, LinkTrust::kWeak);
}

TEST(CutVerdict, OfARightMapIsGoodUnlessItIsCut)
{
  const CutVerdict whole = verdictOf(triangles("a", 0));
  EXPECT_EQ(whole.map.call, TrustCall::kGood);
  EXPECT_TRUE(isRight(whole.map));
  EXPECT_FALSE(whole.is_right_cut || whole.is_misplaced || whole.is_missed);
  const CutVerdict cut = verdictOf(triangles("a", 2));
  EXPECT_EQ(cut.map.call, TrustCall::kDoubted);
  EXPECT_TRUE(isRight(cut.map));
  EXPECT_TRUE(cut.is_right_cut);
}

TEST(CutVerdict, OfAWrongMapIsGoodIfItIsNotCut)
{
  const CutVerdict missed = verdictOf(displaced(triangles("a", 0)));
  EXPECT_EQ(missed.map.call, TrustCall::kGood);
  EXPECT_TRUE(isWrong(missed.map));
  EXPECT_TRUE(missed.is_misplaced && missed.is_missed);
  const CutVerdict cut = verdictOf(displaced(triangles("a", 2)));
  EXPECT_EQ(cut.map.call, TrustCall::kDoubted);
  EXPECT_FALSE(isWrong(cut.map)); // every wrong scan is named
  EXPECT_TRUE(cut.is_misplaced);
  EXPECT_FALSE(cut.is_missed || cut.is_right_cut);
}

TEST(CutVerdict, KeepsDoubtsThatAreNoCuts)
{
  CutRun run = triangles("a", 0);
  run.result.verification->trust = pcl6d::MapTrust::kDoubtful;
  run.result.verification->doubts.emplace_back(pcl6d::RejectReason::kScansContradict);
  EXPECT_EQ(verdictOf(run).map.call, TrustCall::kDoubted);
}

TEST(CutFit, LeavesTheSensorOut)
{
  // Links of the sensor "glassy" are contradicted at right places, too: only a fit with them raises
  // the background.
  std::vector<CutRun> runs = {
      triangles("glassy", 2), triangles("usual", 0), displaced(triangles("usual", 2))};
  CutFit fit(runs);
  const auto without = fit.fitWithout("glassy");
  EXPECT_EQ(fit.counts(without).at("usual").missed, 0U);
  EXPECT_EQ(fit.counts(without).at("glassy").right_cuts, 1U);
  const auto without_usual = fit.fitWithout("usual");
  EXPECT_EQ(fit.counts(without_usual).at("glassy").right_cuts, 0U);
  EXPECT_EQ(fit.counts(without_usual).at("usual").missed, 1U);
  std::ostringstream table;
  pcl6d::bench::printLeftOutSensors(fit, table);
  EXPECT_NE(table.str().find("| usual | 2 | 1 | 1 | 0 | 0 | 1 | 1 | 0 | 0 |"),
            std::string::npos)
      << table.str();
}

TEST(CutFit, WeighsAMissedWrongPlaceAsTenCuts)
{
  CutCounts counts, other;
  counts.missed = 2;
  counts.right_cuts = 3;
  other.runs = 1;
  counts += other;
  EXPECT_EQ(counts.loss(), 23U);
  EXPECT_EQ(counts.runs, 1U);
}
