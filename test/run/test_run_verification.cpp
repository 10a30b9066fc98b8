// SPDX-License-Identifier: BSD-3-Clause
// What a run folder keeps of its verification, and what the verdict says of it.
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/run/run_links_io.h>
#include <pcl6d/run/run_summary.h>
#include <pcl6d/run/run_writer.h>
#include <pcl6d/run/verification_io.h>

#include <gtest/gtest.h>

#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace fs = std::filesystem;
using pcl6d::exactnessOf;
using pcl6d::IoFailed;
using pcl6d::LinkCheck;
using pcl6d::LinkTrust;
using pcl6d::MapTrust;
using pcl6d::MapVerification;
using pcl6d::readRunSummary;
using pcl6d::RunResult;
using pcl6d::RunWriter;
using pcl6d::verdictOf;
using pcl6d::writeRunSummary;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {
/** \return a run of three matched scans with the numbers 0, 2 and 4 */
RunResult
runOfThree()
{
  RunResult run;
  run.generator = "pcl_slam6d";
  run.version = "9.9";
  for (int i = 0; i < 3; ++i) {
    pcl6d::ScanResult scan;
    scan.file = std::string(1, static_cast<char>('a' + i)) + ".pcd";
    scan.index = 2 * i;
    scan.state = i == 0 ? pcl6d::ScanState::kFixed : pcl6d::ScanState::kMatched;
    run.scans.push_back(scan);
  }
  return run;
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

pcl6d::NoticedError
noticedFrom(double least, double most, double turn)
{
  pcl6d::NoticedError noticed;
  noticed.least = least;
  noticed.most = most;
  noticed.turn = turn;
  noticed.weakest = {0.6, -0.8, 0};
  return noticed;
}

/** \return a verification in which every field differs from its default */
MapVerification
doubtful()
{
  MapVerification map;
  map.trust = MapTrust::kDoubtful;
  map.background = 0.1 / 3;
  map.links.resize(2);
  pcl6d::LinkCheck &good = map.links[0], &wrong = map.links[1];
  good.to = 1;
  good.trust = LinkTrust::kGood;
  good.probability_wrong = 1e-7 / 3;
  good.patches = 320;
  good.contradicted = 2;
  good.shift = 0.0125;
  good.deviation = 0.003;
  good.noticed = noticedFrom(0.015, 0.0625, 0.01);
  wrong.from = 1;
  wrong.to = 2;
  wrong.trust = LinkTrust::kWrong;
  wrong.patches = 41;
  wrong.contradicted = 30;
  wrong.shift = 1.5;
  wrong.deviation = 0.25;
  wrong.open_directions = 2;
  wrong.rejection =
      pcl6d::Rejection::stated("rays go through 30 of 41 \"patches\", and more");
  map.scans.resize(3);
  map.scans[0].tied = map.scans[1].tied = map.scans[1].abstains = true;
  map.scans[1].off_centre = true;
  map.scans[0].bound = 0;
  map.scans[1].bound = 0.1 / 7;
  map.scans[1].noticed = noticedFrom(0.1 / 3, kInfinity, kInfinity);
  map.scans[2].doubt = {pcl6d::RejectReason::kLinkNotConsistent,
                        {pcl6d::RejectReason::kTooFewPatches, 3, 12}};
  map.scans[2].doubt.text = "säule.pcd";
  map.doubts = {{pcl6d::RejectReason::kScansDisconnected, map.scans[2].doubt},
                {pcl6d::RejectReason::kScansContradict, 2}};
  map.doubts[0].measured = 1;
  map.doubts[0].text = "c.pcd";
  for (const char* const link : {"a.pcd and b.pcd", "a.pcd and c.pcd"}) {
    map.doubts[1].causes.emplace_back(
        pcl6d::RejectReason::kOfScans,
        pcl6d::Rejection(pcl6d::RejectReason::kPatchesViolated, 30, 41));
    map.doubts[1].causes.back().text = link;
  }
  return map;
}

bool
has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

/** \return the verdict of a run whose map has this trust, with a doubt or none */
std::string
verdictWith(MapTrust trust, const std::vector<std::string>& doubts)
{
  RunResult run = runOfThree();
  MapVerification& map = run.verification.emplace();
  map.trust = trust;
  map.links.resize(2);
  for (const std::string& doubt : doubts)
    map.doubts.push_back(pcl6d::Rejection::stated(doubt));
  return verdictOf(run);
}
} // namespace

TEST(RunVerification, ComesBackAsItWas)
{
  const TempFolder folder;
  RunResult run = runOfThree();
  run.verification = doubtful();
  writeRunSummary(folder / "summary.json", run);
  const RunResult back = readRunSummary(folder / "summary.json");
  ASSERT_TRUE(back.verification);
  EXPECT_EQ(back.verification->trust, MapTrust::kDoubtful);
  EXPECT_EQ(back.verification->background, run.verification->background);
  EXPECT_EQ(back.verification->doubts, run.verification->doubts);
  ASSERT_EQ(back.verification->scans.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &found = back.verification->scans[i], &was = run.verification->scans[i];
    EXPECT_EQ(found.tied, was.tied);
    EXPECT_EQ(found.abstains, was.abstains);
    EXPECT_EQ(found.off_centre, was.off_centre);
    EXPECT_EQ(found.bound, was.bound);
    EXPECT_EQ(found.doubt, was.doubt);
    ASSERT_EQ(found.noticed.has_value(), was.noticed.has_value());
    if (was.noticed) {
      EXPECT_EQ(found.noticed->least, was.noticed->least);
      EXPECT_EQ(found.noticed->most, was.noticed->most);
      EXPECT_EQ(found.noticed->turn, was.noticed->turn);
      EXPECT_EQ(found.noticed->weakest, was.noticed->weakest);
    }
  }
  EXPECT_TRUE(back.verification->links.empty()) << "these stand in verification.csv";
}

TEST(RunVerification, EveryTrustComesBack)
{
  const TempFolder folder;
  for (const MapTrust trust : {MapTrust::kGood,
                               MapTrust::kDoubtful,
                               MapTrust::kAmbiguous,
                               MapTrust::kUnverified}) {
    RunResult run = runOfThree();
    run.verification.emplace().trust = trust;
    run.verification->scans.resize(run.scans.size());
    writeRunSummary(folder / "a.json", run);
    const RunResult back = readRunSummary(folder / "a.json");
    EXPECT_EQ(back.verification->trust, trust);
    writeRunSummary(folder / "b.json", back);
    EXPECT_EQ(readText(folder / "a.json"), readText(folder / "b.json"));
  }
}

TEST(RunVerification, IsCountedInTheSummary)
{
  const TempFolder folder;
  RunResult run = runOfThree();
  run.verification = doubtful();
  writeRunSummary(folder / "summary.json", run);
  const std::string text = readText(folder / "summary.json");
  for (const char* const part : {"\"verdict\": \"doubtful\"",
                                 "\"links\": 2",
                                 "\"consistent\": 1",
                                 "\"inconsistent\": 1"})
    EXPECT_TRUE(has(text, part)) << part << '\n' << text;
}

TEST(RunVerification, IsMissingInOlderSummaries)
{
  const TempFolder folder;
  writeRunSummary(folder / "summary.json", runOfThree());
  EXPECT_FALSE(has(readText(folder / "summary.json"), "\"verification\""));
  const RunResult back = readRunSummary(folder / "summary.json");
  EXPECT_FALSE(back.verification);
  EXPECT_EQ(back.scans.size(), 3u);
}

TEST(RunVerification, BrokenOnesAreNamedWithWhatIsWrong)
{
  const TempFolder folder;
  const fs::path file = folder / "summary.json";
  RunResult run = runOfThree();
  run.verification = doubtful();
  writeRunSummary(file, run);
  const std::string good = readText(file);
  const auto errorOf = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    EXPECT_TRUE(has(text, from)) << from;
    text.replace(text.find(from), from.size(), to);
    writeText(file, text);
    try {
      readRunSummary(file);
    } catch (const IoFailed& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(
      errorOf("\"doubtful\"", "\"fine\""),
      file.string() +
          ": /verification/verdict: trust of a map = fine, but must be one of good, "
          "doubtful, ambiguous, unverified");
  EXPECT_TRUE(
      has(errorOf("\"background\"", "\"ground\""), "key 'background' is missing"));
  EXPECT_TRUE(has(errorOf("\"connected\": true", "\"connected\": 7"),
                  "/scans/0/connected: 7, but must be true or false"));
  EXPECT_TRUE(has(errorOf("\"bound\"", "\"bind\""), "key 'bound' is missing"));
}

TEST(RunVerification, IsATableOfLinksByTheNumbersOfTheirScans)
{
  const TempFolder folder;
  RunResult run = runOfThree();
  run.verification = doubtful();
  RunWriter(folder.path(), run).writeVerification();
  EXPECT_EQ(
      readText(folder / "verification.csv"),
      "from,to,result,probability_wrong,patches,violated,shift,deviation,"
      "open_directions,detectable_least,detectable_largest,detectable_turn,reason\n"
      "0,2,good,3.33333e-08,320,2,0.0125,0.003,0,0.015,0.0625,0.01,\"\"\n"
      "2,4,wrong,1,41,30,1.5,0.25,2,,,,\"rays go through 30 of 41 \"\"patches\"\", "
      "and more\"\n");
}

TEST(RunVerification, IsATableWithoutRowsIfThereAreNoLinks)
{
  const TempFolder folder;
  pcl6d::writeLinkChecks(folder / "verification.csv", {});
  const std::string text = readText(folder / "verification.csv");
  EXPECT_EQ(text.find("from,to,result,"), 0u);
  EXPECT_EQ(text.find('\n'), text.size() - 1);
}

TEST(RunVerification, OfARunWithoutItWritesNothing)
{
  const TempFolder folder;
  const RunResult run = runOfThree();
  RunWriter(folder.path(), run).writeVerification();
  EXPECT_FALSE(fs::exists(folder / "verification.csv"));
}

TEST(Verdict, OfAGoodMapSaysThatItIsVerified)
{
  const std::string text = verdictWith(MapTrust::kGood, {});
  EXPECT_TRUE(has(text, "\nverified by points and rays: 0 of 2 links confirm the map"))
      << text;
  EXPECT_FALSE(has(text, "NOT TO BE TRUSTED"));
}

TEST(Exactness, NamesTheWorstBoundAndTheLeastNoticedShift)
{
  MapVerification map = doubtful();
  map.scans[1].noticed = noticedFrom(0.02, 0.345, 0.1);
  EXPECT_EQ(exactnessOf(map, {"a", "b", "c"}),
            "positions relative to the first scan are known to 1.4 cm or better (95 %, "
            "worst: b)\nthe surest link of each scan would notice a shift of 34 cm or "
            "more (least at b)");
  map.scans[1].noticed = noticedFrom(0.02, kInfinity, 0.1);
  map.scans[1].bound.reset();
  EXPECT_EQ(exactnessOf(map, {"a", "b", "c"}),
            "no link of b would notice a shift along 0.60 -0.80 0.00");
  EXPECT_EQ(exactnessOf({}, {}), "");
}

TEST(Verdict, OfAnUnconvergedMatchIsANoteWhereRaysConfirmThePlace)
{
  RunResult run = runOfThree();
  run.scans[1].state = pcl6d::ScanState::kUnconverged;
  EXPECT_TRUE(has(verdictOf(run), "NOT TO BE TRUSTED: 1 scan did not converge"));
  run.scans[1].status = pcl6d::Status::kRankDeficient;
  EXPECT_TRUE(
      has(verdictOf(run),
          "NOT TO BE TRUSTED: 1 scan placed by the given poses along a direction "
          "that surfaces leave open (a corridor or tunnel without features?): "
          "b.pcd"));
  run.scans[1].status = pcl6d::Status::kMaxIterations;
  run.verification.emplace().trust = MapTrust::kGood;
  EXPECT_TRUE(has(
      verdictOf(run),
      "note: 1 scan did not converge, but points and rays confirm the poses: b.pcd"));
}

TEST(Verdict, OfADoubtfulMapGivesEachDoubt)
{
  for (const MapTrust trust : {MapTrust::kDoubtful, MapTrust::kAmbiguous}) {
    const std::string text = verdictWith(trust, {"first doubt", "second doubt"});
    EXPECT_TRUE(has(text, "\nNOT TO BE TRUSTED: first doubt\n")) << text;
    EXPECT_TRUE(has(text, "\nNOT TO BE TRUSTED: second doubt")) << text;
    EXPECT_FALSE(has(text, "verified by"));
  }
}

TEST(Verdict, OfAnUnverifiedMapDoesNotCallItVerified)
{
  const std::string text =
      verdictWith(MapTrust::kUnverified, {"1 scan cannot be verified"});
  EXPECT_TRUE(has(text, "\nunverified: 1 scan cannot be verified")) << text;
  EXPECT_FALSE(has(text, "NOT TO BE TRUSTED"));
  EXPECT_FALSE(has(text, "verified by points and rays"));
}

TEST(Verdict, WithoutVerificationSaysNothingOfIt)
{
  EXPECT_FALSE(has(verdictOf(runOfThree()), "verified"));
}
