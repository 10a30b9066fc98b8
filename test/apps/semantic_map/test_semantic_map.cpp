// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_semantic_map as a user runs it.
#include "apps/semantic_map/semantic_run.h"

#include <pcl6d/semantic_map/semantic_map_io.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

using namespace pcl6d;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::SemanticRun;
using pcl6d::test::writeText;

namespace {
constexpr const char* kName = "pcl_slam6d_semantic_map";

Outcome
program(const std::vector<std::string>& arguments)
{
  return pcl6d::test::runProgram(kName, arguments);
}

void
expectError(const Outcome& outcome, int code, const std::vector<std::string>& words)
{
  pcl6d::test::expectError(outcome, kName, code, words);
}

/** A run and its map from the true planes and objects, made once. */
struct TrueMap : SemanticRun {
  TrueMap()
  {
    built = program({"build",
                     run().string(),
                     "--planes",
                     (sim() / "planes_truth.json").string(),
                     "--objects",
                     (sim() / "objects_truth.json").string()});
  }
  Outcome built;

  /** \return the results of a query as JSON */
  nlohmann::json
  ask(const std::string& query) const
  {
    const Outcome outcome = program({"query", run().string(), query, "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out)["results"];
  }
};

const TrueMap&
trueMap()
{
  static const TrueMap map;
  return map;
}

std::set<int>
idsOf(const nlohmann::json& results)
{
  std::set<int> ids;
  for (const auto& result : results)
    ids.insert(result["id"].get<int>());
  return ids;
}
} // namespace

TEST(SemanticMap, BuildsFromTruePlanesAndObjects)
{
  ASSERT_EQ(trueMap().built.exit_code, 0) << trueMap().built.err;
  const SemanticMap map = readSemanticMap(trueMap().run() / "semantic_map.json");
  EXPECT_EQ(map.scans.size(), static_cast<std::size_t>(SemanticRun::kScans));
  ASSERT_EQ(map.links.size(), 1u) << "refused ones are left out";
  EXPECT_EQ(map.links[0].pairs, 100u);
  EXPECT_EQ(map.storeys.size(), 1u);
  EXPECT_NEAR(map.storeys[0].floor, -0.9, 1e-3); // the scanner's height
  EXPECT_GE(map.rooms.size(), 4u);
  EXPECT_LE(map.rooms.size(), 7u) << "a corridor and six rooms";

  const Scan cloud = readScan(trueMap().run() / "semantic_map.pcd");
  const auto label = fieldValues(cloud.cloud, "label");
  const auto object_id = fieldValues(cloud.cloud, "object_id");
  ASSERT_TRUE(label && object_id && fieldValues(cloud.cloud, "plane_id") &&
              fieldValues(cloud.cloud, "rgb") && fieldValues(cloud.cloud, "scan"));
  const auto floor = std::count(label->values.begin(), label->values.end(), 1.0);
  EXPECT_GT(floor, static_cast<long>(label->values.size() / 10));
  EXPECT_GT(*std::max_element(object_id->values.begin(), object_id->values.end()), 0);
}

TEST(SemanticMap, LabelsPointsAsTheTruthDoes)
{
  // the simulator tells for each point of a scan which object it lies on
  const SemanticMap map = readSemanticMap(trueMap().run() / "semantic_map.json");
  std::size_t seen = 0, agreed = 0;
  for (std::size_t object = 0; object < map.objects.size(); ++object)
    for (int i = 0; i < SemanticRun::kScans; ++i) {
      const Scan scan = readScan(trueMap().sim() / (scanName(i) + ".pcd"));
      const auto ids = fieldValues(scan.cloud, "object_id");
      ASSERT_TRUE(ids);
      const auto points = std::count(
          ids->values.begin(), ids->values.end(), static_cast<double>(object + 1));
      const auto& scans = map.objects[object].scans;
      const bool says =
          std::count(scans.begin(), scans.end(), static_cast<std::size_t>(i)) > 0;
      if (points < 30) // near the limit of 10 points both may be right
        continue;
      ++seen;
      agreed += says;
    }
  EXPECT_GT(seen, 20u);
  EXPECT_GE(agreed, seen * 98 / 100);
}

TEST(SemanticMap, AnswersThreeQueriesOfTheRooms)
{
  const TrueMap& map = trueMap();
  // 1: chairs on the floor of the room that has a table and a shelf
  const auto rooms = map.ask("rooms has=table not has=bed");
  ASSERT_EQ(rooms.size(), 1u) << "the other table's room was not seen";
  const std::string room = std::to_string(rooms[0]["id"].get<int>());
  EXPECT_EQ(idsOf(map.ask("objects class=chair on=floor room=" + room)),
            (std::set<int>{7, 8}));
  EXPECT_EQ(idsOf(map.ask("objects class=chair next_to=table")),
            (std::set<int>{7, 8, 20, 21}));
  // 2: large walls parallel to one between two rooms
  const auto walls = map.ask("planes label=wall area>10 parallel=49 room=*");
  EXPECT_EQ(idsOf(walls).count(50), 1u) << "its other face";
  for (const auto& wall : walls)
    EXPECT_GT(wall["area"].get<double>(), 10);
  // 3: the scans that saw a shelf, against the truth of the points
  std::set<int> saw;
  for (int i = 0; i < SemanticRun::kScans; ++i) {
    const Scan scan = readScan(map.sim() / (scanName(i) + ".pcd"));
    const auto ids = fieldValues(scan.cloud, "object_id");
    if (std::count(ids->values.begin(), ids->values.end(), 3.0) >= 30)
      saw.insert(i);
  }
  EXPECT_FALSE(saw.empty());
  const std::set<int> answered = idsOf(map.ask("scans seen=object:3"));
  EXPECT_TRUE(std::includes(answered.begin(), answered.end(), saw.begin(), saw.end()));
  EXPECT_LE(answered.size(), saw.size() + 2);
}

TEST(SemanticMap, FindsThePlanesItselfAndGivesTheSameBytesForAnyNumberOfThreads)
{
  const TrueMap& map = trueMap();
  const auto build = [&](const std::string& name, const std::string& threads) {
    const Outcome outcome = program({"build",
                                     map.run().string(),
                                     "-o",
                                     (map / (name + ".json")).string(),
                                     "--cloud",
                                     (map / (name + ".ply")).string(),
                                     "--quiet",
                                     "--threads",
                                     threads});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  };
  build("one", "1");
  build("three", "3");
  EXPECT_EQ(readText(map / "one.json"), readText(map / "three.json"));
  EXPECT_EQ(readText(map / "one.ply"), readText(map / "three.ply"));
  const SemanticMap found = readSemanticMap(map / "one.json");
  const SemanticMap truth = readSemanticMap(map.run() / "semantic_map.json");
  EXPECT_TRUE(found.objects.empty());
  ASSERT_EQ(found.storeys.size(), 1u);
  EXPECT_NEAR(found.storeys[0].floor, truth.storeys[0].floor, 0.02);
  // a room of the truth and one that was found at its centre, of the same size; 16 scans
  // do not see enough of the walls of all rooms
  const auto num_found =
      std::count_if(truth.rooms.begin(), truth.rooms.end(), [&](const MapRoom& room) {
        const Eigen::Vector3d centre = centreOf(room, truth.up);
        return std::any_of(
            found.rooms.begin(), found.rooms.end(), [&](const MapRoom& other) {
              return isInPlan(other, found.up, centre) &&
                     std::abs(other.area - room.area) < 0.15 * room.area;
            });
      });
  EXPECT_GE(2 * num_found, static_cast<long>(truth.rooms.size()));
  EXPECT_EQ(std::count_if(found.planes.begin(),
                          found.planes.end(),
                          [](const MapPlane& plane) { return bool(plane.refined); }) >
                0,
            true);
}

TEST(SemanticMap, TellsWhatAMapHoldsAndPrintsTables)
{
  const TrueMap& map = trueMap();
  const Outcome info = program({"info", (map.run() / "semantic_map.json").string()});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  for (const char* const word :
       {"scans 16 links 1", "2 table", "4 chair", "storeys 1", "room 1", "on"})
    EXPECT_NE(info.out.find(word), std::string::npos) << word << " in " << info.out;
  const Outcome table = program({"query", map.run().string(), "objects class=bed"});
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_EQ(table.out.rfind("id  class  score", 0), 0u) << table.out;
  EXPECT_NE(table.out.find("\n1 row\n"), std::string::npos) << table.out;
}

TEST(SemanticMap, MarksErrorsOfQueries)
{
  const std::string run = trueMap().run().string();
  const Outcome wrong = program({"query", run, "objects class chair"});
  expectError(wrong, 2, {"column 15", "'chair'"});
  EXPECT_EQ(wrong.err.rfind("objects class chair\n              ^\n", 0), 0u)
      << wrong.err;
  EXPECT_EQ(wrong.out, "");
  expectError(program({"query", run, "planes on=object:99"}), 2, {"column 8"});
  expectError(program({"query", run}), 2, {"QUERY"});
}

TEST(SemanticMap, RefusesAWrongCommandLine)
{
  const TrueMap& map = trueMap();
  const std::string run = map.run().string();
  expectError(program({"find"}), 2, {"'find'", "build, query, info"});
  expectError(program({"build"}), 2, {"RUN_DIR"});
  expectError(program({"build", run, "--threads", "-1"}), 2, {"--threads = -1"});
  expectError(program({"build", run, "--objects", "a.json", "--model", "a.ply"}),
              2,
              {"--objects", "--model"});
  expectError(
      program({"build", run, "--cloud", "x.xyz"}), 2, {"x.xyz", ".pcd or .ply"});
  expectError(program({"build", run, "-o", run + "/summary.json"}),
              2,
              {"summary.json, but that is an input"});
  expectError(program({"build", run, "--cloud", run + "/map.pcd"}),
              2,
              {"map.pcd, but that is an input"});
  expectError(program({"build", run, "-o", run + "/links.csv"}),
              2,
              {"links.csv, but that is an input"});
  expectError(program({"build", run, "--cloud", run + "/scans/scan000.pcd"}),
              2,
              {"scan000.pcd, but that is an input"});
  expectError(program({"build", run, "-o", "one.ply", "--cloud", "./one.ply"}),
              2,
              {"both ./one.ply"});
  EXPECT_EQ(program({"--help"}).exit_code, 0);
  EXPECT_EQ(program({"--version"}).exit_code, 0);
  EXPECT_NE(program({"query", "--help"}).out.find("CONDITION"), std::string::npos);
}

TEST(SemanticMap, NamesWhatIsWrongWithTheData)
{
  const TrueMap& map = trueMap();
  const std::string run = map.run().string();
  const auto buildWith = [&](const std::string& option, const std::string& content) {
    writeText(map / "bad.json", content);
    return program({"build",
                    run,
                    "-o",
                    (map / "out.json").string(),
                    "--cloud",
                    (map / "out.pcd").string(),
                    option,
                    (map / "bad.json").string()});
  };
  expectError(program({"build", map.sim().string()}), 1, {"summary.json"});
  expectError(
      program({"query", map.sim().string(), "rooms"}), 1, {"semantic_map.json"});
  expectError(buildWith("--planes", "{}"), 1, {"bad.json"});
  expectError(buildWith("--objects", "{\"objects\": 3}"), 1, {"bad.json", "/objects"});
  expectError(buildWith("--objects",
                        R"({"objects": [{"class": "a", "scans": [99],
 "T_world_object": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}]})"),
              1,
              {"bad.json", "object 1", "scan 99"});
  expectError(buildWith("--objects",
                        R"({"objects": [{"class": "",
 "T_world_object": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]}]})"),
              1,
              {"class"});
  EXPECT_FALSE(std::filesystem::exists(map / "out.json"));
  const std::string cloud = (map / "out.pcd").string(), json = (map / "no/it").string();
  expectError(
      program({"build", run, "--cloud", cloud, "-o", json}), 1, {"no/it: No such"});
  EXPECT_FALSE(std::filesystem::exists(cloud)); // not one without the other
  const auto broken = map / "broken";
  std::filesystem::copy(map.run(), broken, std::filesystem::copy_options::recursive);
  for (const char* const row :
       {"0,99,loop,used,3,0.1", "0,-1,loop,used,3,0.1", "0,1"}) {
    writeText(broken / "links.csv",
              std::string("from,to,kind,verdict,pairs,rms\n") + row + "\n");
    expectError(program({"build", broken.string()}), 1, {"links.csv", "line 2"});
  }
  const auto gone = map / "gone";
  std::filesystem::copy(map.run(), gone, std::filesystem::copy_options::recursive);
  std::filesystem::remove(gone / "scans/scan001.pcd");
  expectError(program({"build", gone.string()}), 1, {"scan001.pcd", "is missing"});
  writeText(map / "cut.json", readText(map.run() / "semantic_map.json").substr(0, 999));
  expectError(program({"info", (map / "cut.json").string()}), 1, {"cut.json", "line"});
}
