// SPDX-License-Identifier: BSD-3-Clause
// Files of version 0.1.0 have schema_version 1, with other names of some keys.
#include "io/io_test.h"
#include "support/folders.h"
#include "support/temp_folder.h"

#include <pcl6d/run/run_links_io.h>
#include <pcl6d/run/run_summary.h>

#include <nlohmann/json.hpp>

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using pcl6d::IoFailed;
using pcl6d::readRunSummary;
using pcl6d::RunResult;
using pcl6d::test::messageOf;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {
/** \return a run with a value in every field that has another key in schema_version 1 */
RunResult
runWithEveryRenamedField()
{
  RunResult run;
  run.generator = "pcl_slam6d";
  run.trusted = false;
  run.moved = {pcl6d::PoseReading::kScanner, {512345, -7, 1}};
  run.links_refused = 3;
  run.floating = {"b.pcd"};
  run.graph_stages.emplace_back().reverted = true;
  for (const char* const file : {"a.pcd", "b.pcd"}) {
    pcl6d::ScanResult& scan = run.scans.emplace_back();
    scan.file = file;
    scan.index = static_cast<int>(run.scans.size()) - 1;
    scan.points = 10;
  }
  run.scans[1].motion.emplace().deskewed = true;
  run.moving.emplace().points = {0, 7};
  run.moving->blind = true;
  run.drive.emplace().files = {"a.pcd", "b.pcd"};
  run.drive->way = 12.5;
  pcl6d::MapVerification& map = run.verification.emplace();
  map.trust = pcl6d::MapTrust::kAmbiguous;
  map.scans.resize(2);
  map.scans[0].tied = map.scans[1].abstains = true;
  pcl6d::NoticedError& least_error = map.scans[1].noticed.emplace();
  least_error.least = 0.25;
  least_error.most = 0.5;
  least_error.turn = 0.125;
  least_error.weakest = {0.6, -0.8, 0};
  return run;
}

void
rename(Json& object, const char* from, const char* to)
{
  ASSERT_TRUE(object.contains(from)) << from;
  object[to] = object[from];
  object.erase(from);
}

/** \return the same summary in the layout of version 0.1.0 */
Json
inFirstSchema(Json json)
{
  json["schema_version"] = 1;
  rename(json, "input_offset", "moved_points");
  rename(json["verdict"], "reliable", "trusted");
  rename(json["graph"]["stages"][0], "reverted", "undone");
  rename(json["graph"], "links_rejected", "links_refused");
  rename(json["graph"], "disconnected", "floating");
  rename(json["scans"][1]["motion"], "deskewed", "undone");
  rename(json["dynamic"], "inconclusive", "blind");
  rename(json, "dynamic", "moving");
  rename(json["drive"], "path_length", "way");
  Json& map = json["verification"];
  rename(map, "verdict", "trust");
  rename(map, "consistent", "good");
  rename(map, "inconsistent", "wrong");
  Json& detectable = map["scans"][1]["detectable"];
  rename(detectable, "least_shift", "least");
  rename(detectable, "largest_shift", "most");
  rename(detectable, "weakest_direction", "weakest");
  for (Json& scan : map["scans"]) {
    rename(scan, "connected", "tied");
    rename(scan, "rays_unreliable", "abstains");
    rename(scan, "detectable", "noticed");
  }
  return json;
}
} // namespace

TEST(SchemaVersions, ASummaryOfTheFirstHasEveryField)
{
  const TempFolder folder;
  writeRunSummary(folder / "now.json", runWithEveryRenamedField());
  const std::string now = readText(folder / "now.json");
  const Json json = Json::parse(now);
  EXPECT_EQ(json["schema_version"], 2);
  writeText(folder / "first.json", inFirstSchema(json).dump());
  writeRunSummary(folder / "again.json", readRunSummary(folder / "first.json"));
  EXPECT_EQ(readText(folder / "again.json"), now);
}

TEST(SchemaVersions, SummariesWrittenByVersion010AreRead)
{
  const fs::path corpus = PCL6D_SOURCE_DIR "/test/fuzz/corpus/run_summary";
  const RunResult run = readRunSummary(corpus / "run");
  EXPECT_EQ(run.version, "0.1.0");
  EXPECT_EQ(run.scans.size(), 3u);
  ASSERT_TRUE(run.verification);
  EXPECT_EQ(run.verification->trust, pcl6d::MapTrust::kDoubtful);
  EXPECT_TRUE(run.verification->scans[0].tied);
  EXPECT_FALSE(run.verification->scans[1].tied);
  EXPECT_FALSE(run.verification->scans[0].doubt);
  EXPECT_EQ(run.verification->scans[1].doubt,
            pcl6d::Rejection::stated(
                "with scan000.pcd: only 0 patches of surface in common"));
  ASSERT_EQ(run.verification->doubts.size(), 1u);
  EXPECT_EQ(run.verification->doubts[0].reason, pcl6d::RejectReason::kStated);
  EXPECT_TRUE(readRunSummary(corpus / "moved").moved);
}

TEST(SchemaVersions, KeysOfOneAreNotTakenInAnother)
{
  const TempFolder folder;
  writeRunSummary(folder / "now.json", runWithEveryRenamedField());
  Json json = inFirstSchema(Json::parse(readText(folder / "now.json")));
  json["schema_version"] = 2;
  writeText(folder / "mixed.json", json.dump());
  EXPECT_NE(messageOf<IoFailed>([&] {
              readRunSummary(folder / "mixed.json");
            }).find("/verdict: key 'reliable' is missing"),
            std::string::npos);
}

TEST(SchemaVersions, ATableOfLinksOfTheFirstIsRead)
{
  const TempFolder folder;
  writeText(folder / "verification.csv",
            "from,to,trust,probability_wrong,patches,contradicted,shift,deviation,"
            "open_directions,noticed_least,noticed_most,noticed_turn,reason\n"
            "0,2,good,3.3e-08,320,2,0.0125,0.003,0,0.015,0.0625,0.01,\"\"\n"
            "2,4,wrong,1,41,30,1.5,0.25,2,,,,\"rays, contradict\"\n");
  const auto links = pcl6d::readLinkChecks(folder / "verification.csv");
  ASSERT_EQ(links.size(), 2u);
  EXPECT_EQ(links[0].trust, pcl6d::LinkTrust::kGood);
  EXPECT_EQ(links[0].contradicted, 2u);
  ASSERT_TRUE(links[0].noticed);
  EXPECT_EQ(links[0].noticed->least, 0.015);
  EXPECT_EQ(links[0].noticed->most, 0.0625);
  EXPECT_EQ(links[0].noticed->turn, 0.01);
  EXPECT_EQ(links[1].trust, pcl6d::LinkTrust::kWrong);
  EXPECT_FALSE(links[1].noticed);
}
