// SPDX-License-Identifier: BSD-3-Clause
#include "semantic_map/small_map.h"
#include "support/bits.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/semantic_map/find_rooms.h>
#include <pcl6d/semantic_map/map_relations.h>
#include <pcl6d/semantic_map/semantic_map_io.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <functional>
#include <limits>

using namespace pcl6d;
using nlohmann::json;
using pcl6d::test::readText;
using pcl6d::test::sameBits;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {
SemanticMap
fullMap()
{
  SemanticMap map = test::twoRooms();
  map.world_offset = {500000, 5000000, 120};
  map.scans[1].covariance = Eigen::Matrix<double, 6, 6>::Identity() / 3;
  map.scans[1].T_world_scan = poseFromEuler({1.0 / 3, -1e-9, 5e6 / 7}, {0.1, 0.2, 0.3});
  map.links = {{0, 2, "sequence", 120, 0.1 / 3, {}}, {4, 0, "loop", 80, 0.02, {}}};
  map.links[1].information = Eigen::Matrix<double, 6, 6>::Identity() * 1e6 / 7;
  map.planes[0].refined = map.planes[0].measured;
  map.planes[0].refined->rms = 1.0 / 7;
  map.objects[1].covariance = Eigen::Matrix<double, 6, 6>::Identity() * 1e-4 / 3;
  map.objects[1].symmetry = 0;
  map.objects[1].pose.moves = true;
  map.objects[2].pose.object_class = "Tasse \"ä\", \\ / 'x'";
  findRooms(map);
  map.relations = findRelations(map);
  return map;
}

/** \return what reading a changed file says */
std::string
faultOf(const std::function<void(json&)>& change)
{
  static const std::string written = [] {
    const TempFolder folder;
    writeSemanticMap(folder / "map.json", fullMap());
    return readText(folder / "map.json");
  }();
  const TempFolder folder;
  json content = json::parse(written);
  change(content);
  writeText(folder / "map.json", content.dump());
  try {
    readSemanticMap(folder / "map.json");
  } catch (const IoFailed& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.rfind((folder / "map.json").string() + ": ", 0), 0u) << message;
    return message;
  }
  return "no error";
}
} // namespace

TEST(SemanticMapIo, GivesEveryBitBack)
{
  const TempFolder folder;
  const SemanticMap map = fullMap();
  writeSemanticMap(folder / "map.json", map);
  const SemanticMap read = readSemanticMap(folder / "map.json");
  writeSemanticMap(folder / "again.json", read);
  EXPECT_EQ(readText(folder / "map.json"), readText(folder / "again.json"));
  EXPECT_TRUE(sameBits(read.up, map.up));
  EXPECT_TRUE(sameBits(read.world_offset, map.world_offset));
  ASSERT_EQ(read.scans.size(), map.scans.size());
  EXPECT_TRUE(sameBits(read.scans[1].T_world_scan, map.scans[1].T_world_scan));
  EXPECT_TRUE(sameBits(*read.scans[1].covariance, *map.scans[1].covariance));
  EXPECT_FALSE(read.scans[0].covariance);
  EXPECT_EQ(read.scans[2].id, 4u);
  ASSERT_EQ(read.links.size(), 2u);
  EXPECT_EQ(read.links[0].rms, map.links[0].rms);
  EXPECT_TRUE(sameBits(*read.links[1].information, *map.links[1].information));
  ASSERT_EQ(read.planes.size(), map.planes.size());
  EXPECT_EQ(read.planes[0].refined->rms, 1.0 / 7);
  EXPECT_FALSE(read.planes[1].refined);
  for (std::size_t i = 0; i < map.planes.size(); ++i) {
    const Plane &a = read.planes[i].measured, &b = map.planes[i].measured;
    EXPECT_TRUE(sameBits(a.normal, b.normal));
    EXPECT_EQ(a.offset, b.offset);
    EXPECT_EQ(a.label, b.label);
    EXPECT_EQ(a.area, b.area);
    ASSERT_EQ(a.hull.size(), b.hull.size());
    EXPECT_TRUE(sameBits(a.hull[2], b.hull[2]));
    EXPECT_EQ(read.planes[i].scans, map.planes[i].scans);
  }
  ASSERT_EQ(read.objects.size(), map.objects.size());
  for (std::size_t i = 0; i < map.objects.size(); ++i) {
    const MapObject &a = read.objects[i], &b = map.objects[i];
    EXPECT_EQ(a.pose.object_class, b.pose.object_class);
    EXPECT_TRUE(sameBits(a.pose.T_world_object, b.pose.T_world_object));
    EXPECT_TRUE(sameBits(a.pose.box.min(), b.pose.box.min()));
    EXPECT_TRUE(sameBits(a.pose.box.max(), b.pose.box.max()));
    EXPECT_EQ(a.covariance.has_value(), b.covariance.has_value());
    EXPECT_EQ(a.symmetry, b.symmetry);
    EXPECT_EQ(a.pose.moves, b.pose.moves);
    EXPECT_EQ(a.score, b.score);
    EXPECT_EQ(a.scans, b.scans);
  }
  ASSERT_EQ(read.rooms.size(), map.rooms.size());
  EXPECT_EQ(read.rooms[0].outline.size(), map.rooms[0].outline.size());
  EXPECT_EQ(read.storeys[0].ceiling, map.storeys[0].ceiling);
  ASSERT_EQ(read.relations.size(), map.relations.size());
  for (std::size_t i = 0; i < map.relations.size(); ++i) {
    EXPECT_EQ(read.relations[i].first, map.relations[i].first);
    EXPECT_EQ(read.relations[i].predicate, map.relations[i].predicate);
    EXPECT_EQ(read.relations[i].second, map.relations[i].second);
  }
}

TEST(SemanticMapIo, AnEmptyMapIsOne)
{
  const TempFolder folder;
  writeSemanticMap(folder / "map.json", {});
  EXPECT_TRUE(readSemanticMap(folder / "map.json").planes.empty());
}

TEST(SemanticMapIo, NamesFileAndPlaceOfWhatIsWrong)
{
  struct Case {
    std::function<void(json&)> change;
    const char* place;
    const char* words;
  };
  const std::vector<Case> cases = {
      {[](json& m) { m = 3; }, "/: ", "no object"},
      {[](json& m) { m["schema_version"] = 2; }, "/schema_version", "must be 1"},
      {[](json& m) { m.erase("planes"); }, "", "key 'planes' is missing"},
      {[](json& m) { m["planes"] = 1; }, "/planes: ", "no array"},
      {[](json& m) { m["planes"][3].erase("offset"); }, "/planes/3", "'offset'"},
      {[](json& m) { m["planes"][3]["area"] = "big"; }, "/planes/3/area", "\"big\""},
      {[](json& m) { m["planes"][3]["id"] = 9; }, "/planes/3/id", "must be 4"},
      {[](json& m) { m["planes"][3]["normal"][0] = 5; },
       "/planes/3/normal",
       "of length 1"},
      {[](json& m) { m["planes"][3]["normal"].push_back(0); },
       "/planes/3/normal",
       "expected 3 numbers, got 4"},
      {[](json& m) { m["planes"][0]["refined"]["hull"][1][2] = nullptr; },
       "/planes/0/refined/hull/1/2",
       "not a number"},
      {[](json& m) { m["planes"][0]["scans"][1] = 1; },
       "/planes/0/scans/1",
       "1, but must be in this map"},
      {[](json& m) { m["scans"][1]["id"] = 0; }, "/scans/1/id", "larger"},
      {[](json& m) { m["scans"][1]["T_world_scan"][0] = 7; },
       "/scans/1/T_world_scan",
       "a rigid motion"},
      {[](json& m) { m["scans"][1]["T_world_scan"][15] = 2; },
       "/scans/1/T_world_scan",
       "a rigid motion"},
      {[](json& m) { m["links"][0]["to"] = 77; }, "/links/0/to", "77"},
      {[](json& m) { m["links"][0]["pairs"] = -1; }, "/links/0/pairs", "-1"},
      {[](json& m) { m["objects"][0]["class"] = 3; }, "/objects/0/class", "text"},
      {[](json& m) { m["objects"][0]["class"] = ""; }, "/objects/0/class", "a name"},
      {[](json& m) { m["objects"][1]["covariance"][0][0] = -1; },
       "/objects/1/covariance",
       "not positive semidefinite"},
      {[](json& m) { m["objects"][0]["symmetry"] = -2; },
       "/objects/0/symmetry",
       ">= 0"},
      {[](json& m) { m["objects"][0]["box_max"][0] = -9; },
       "/objects/0/box_max",
       ">= box_min"},
      {[](json& m) { m["objects"][1]["covariance"][0].push_back(1); },
       "/objects/1/covariance",
       "36 numbers, got 37"},
      {[](json& m) { m["rooms"][0]["storey"] = 2; }, "/rooms/0/storey", "in this map"},
      {[](json& m) { m["relations"][0] = "plane:1 on"; }, "/relations/0", "second"},
      {[](json& m) { m["relations"][0] = 1; }, "/relations/0", "text"},
      {[](json& m) { m["relations"][0] = "plane:99 parallel plane:1"; },
       "/relations/0",
       "in this map"},
      {[](json& m) { m["relations"][0] = "plane parallel plane:1"; },
       "/relations/0",
       "in this map"},
      {[](json& m) { m["relations"][0] = "plane:1 likes plane:2"; },
       "/relations/0",
       "predicate"}};
  for (const auto& wrong : cases) {
    const std::string message = faultOf(wrong.change);
    EXPECT_NE(message.find(wrong.place), std::string::npos) << message;
    EXPECT_NE(message.find(wrong.words), std::string::npos)
        << wrong.words << " in " << message;
  }
  EXPECT_EQ(faultOf([](json& m) { m["new"] = 1; }), "no error");
}

TEST(SemanticMapIo, RefusesWhatIsNoFile)
{
  const TempFolder folder;
  writeText(folder / "cut", "{\"schema_version\": 1,\n \"up\": [0, 0");
  for (const char* const name : {"missing", "cut"})
    EXPECT_THROW(readSemanticMap(folder / name), IoFailed) << name;
  EXPECT_THROW(readSemanticMap(folder.path()), IoFailed);
  SemanticMap map = fullMap();
  map.planes[2].measured.area = std::numeric_limits<double>::quiet_NaN();
  try {
    writeSemanticMap(folder / "map.json", map);
    FAIL();
  } catch (const BadArgument& error) {
    EXPECT_NE(std::string(error.what()).find("/planes/2/area"), std::string::npos);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "map.json"));
  EXPECT_THROW(writeSemanticMap(folder / "no/map.json", fullMap()), IoFailed);
}

TEST(SemanticMapIo, ReadsListsOfObjects)
{
  const TempFolder folder;
  writeText(folder / "objects.json",
            R"({"schema_version": 1, "objects": [
 {"id": 1, "class": "chair", "T_world_object": [1,0,0,2, 0,1,0,3, 0,0,1,4, 0,0,0,1],
  "extent": [0.4, 0.6, 1], "centre": [0, 0, 0.5], "moves": false, "points": 12},
 {"class": "mug", "T_world_object": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1],
  "score": 0.7, "scans": [3, 5], "symmetry": 0, "rms": 0.01}]})");
  const auto objects = readMapObjects(folder / "objects.json");
  ASSERT_EQ(objects.size(), 2u);
  EXPECT_EQ(objects[0].pose.points, 12u);
  EXPECT_EQ(objects[0].pose.box.max(), Eigen::Vector3d(0.2, 0.3, 1));
  EXPECT_EQ(objects[0].pose.T_world_object.translation(), Eigen::Vector3d(2, 3, 4));
  EXPECT_EQ(objects[1].scans, (std::vector<std::size_t>{3, 5}));
  EXPECT_EQ(objects[1].symmetry, 0);
  EXPECT_EQ(objects[1].score, 0.7);
  writeText(folder / "broken.json", R"({"objects": [{"class": "x"}]})");
  try {
    readMapObjects(folder / "broken.json");
    FAIL();
  } catch (const IoFailed& error) {
    EXPECT_NE(
        std::string(error.what()).find("/objects/0: key 'T_world_object' is missing"),
        std::string::npos)
        << error.what();
  }
}
