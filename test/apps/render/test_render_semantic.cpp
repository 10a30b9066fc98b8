// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_render picture of what a map means: objects with their shapes, labels, rooms.
#include "apps/support/program_names.h"
#include "apps/support/room_run.h"
#include "support/folders.h"

#include <pcl6d/semantic_map/semantic_map_io.h>

#include <gtest/gtest.h>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::kRender;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::roomCloud;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

/** A copy of the run of a room, to which things are added. */
struct Copy : TempFolder {
  Copy() { fs::copy(pcl6d::test::room().run(), run(), fs::copy_options::recursive); }

  fs::path
  run() const
  {
    return *this / "run";
  }

  Outcome
  draw(const std::string& view, std::vector<std::string> more) const
  {
    more.insert(more.begin(),
                {"picture",
                 run().string(),
                 "--view",
                 view,
                 "--size",
                 "400x300",
                 "-o",
                 (*this / "a.png").string()});
    return pcl6d::test::runProgram(kRender, more);
  }

  /** \return the bytes of the picture */
  std::string
  drawn(const std::string& view, const std::vector<std::string>& more = {}) const
  {
    const Outcome outcome = draw(view, more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return readText(*this / "a.png");
  }
};

/** A tetrahedron, as tall as the chair of the room. */
constexpr const char* kShape = "v -0.3 -0.3 -1\nv 0.3 -0.3 -1\nv 0 0.3 -1\nv 0 0 0\n"
                               "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/** The map of the room: all points are of the floor, half the room is a room. */
void
writeSemanticMap(const fs::path& run)
{
  pcl6d::SemanticMap map;
  map.storeys.push_back({-1, 1.5, 12});
  map.rooms.push_back(
      {1, 12, 2.5, {{-3, -2, -1}, {0, -2, -1}, {0, 2, -1}, {-3, 2, -1}}});
  pcl6d::MapObject chair;
  chair.pose = pcl6d::readObjects(run / "objects.json").front();
  map.objects.push_back(chair);
  pcl6d::writeSemanticMap(run / "semantic_map.json", map);
  pcl::PCLPointCloud2 cloud = roomCloud({0});
  pcl6d::addField(
      cloud, "label", pcl::PCLPointField::UINT32, std::vector<double>(cloud.width, 1));
  pcl6d::writePcd(run / "semantic_map.pcd", cloud);
}
} // namespace

TEST(RenderObjects, TakesMeshesByClassAndStoresAlike)
{
  const Copy copy;
  const std::string boxes = copy.drawn("objects");
  fs::create_directories(copy / "meshes");
  writeText(copy / "meshes/chair.obj", kShape);
  const std::string with_mesh = copy.drawn("objects", {"--models", copy / "meshes"});
  EXPECT_NE(with_mesh, boxes);
  fs::create_directories(copy / "store/any name");
  fs::create_directories(copy / "store/other");
  writeText(copy / "store/any name/shape.obj", kShape);
  writeText(copy / "store/other/shape.obj", kShape);
  writeText(copy / "store/any name/model.json",
            R"({"schema_version": 1, "class": "chair", "file": "shape.obj"})");
  writeText(copy / "store/other/model.json",
            R"({"schema_version": 1, "class": "bin", "file": "shape.obj"})");
  EXPECT_EQ(copy.drawn("objects", {"--models", copy / "store"}), with_mesh);
  EXPECT_EQ(copy.drawn("objects", {"--models", copy / "store/any name"}), with_mesh);
  EXPECT_NE(copy.drawn("objects", {"--models", PCL6D_SOURCE_DIR "/share/models"}),
            boxes);
}

TEST(RenderObjects, TakesWhatPclSlam6dObjectsWrites)
{
  const Copy copy;
  const fs::path file = copy.run() / "objects.json";
  const std::string by_extent = copy.drawn("objects");
  pcl6d::MapObject chair;
  chair.pose = pcl6d::readObjects(file).front();
  pcl6d::writeMapObjects(file, {chair});
  EXPECT_EQ(copy.drawn("objects"), by_extent);
  for (const auto& [box, words] :
       {std::pair("\"box_min\": [0, 0, 1], \"box_max\": [1, 1, 0]", "box_max"),
        std::pair("\"extent\": [1, -1, 1]", "extent"),
        std::pair("\"centre\": [0, 0, 0]", "has no box")}) {
    writeText(file,
              std::string(R"({"objects": [{"class": "chair", "T_world_object":
              [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1], )") +
                  box + "}]}");
    pcl6d::test::expectError(
        copy.draw("objects", {}), kRender, 1, {"objects.json", "/objects/0", words});
  }
}

TEST(RenderObjects, RefusesModelsThatAreNone)
{
  const Copy copy;
  const auto refuses = [&](const std::string& models,
                           const std::vector<std::string>& words) {
    pcl6d::test::expectError(
        copy.draw("objects", {"--models", models}), kRender, 1, words);
    EXPECT_FALSE(fs::exists(copy / "a.png"));
  };
  refuses(copy / "nowhere", {"nowhere", "no such folder"});
  refuses(copy.run() / "scans", {"scans", "no shape of a chair", "CLASS.ply"});
  writeText(copy / "chair.ply", "rubbish");
  refuses(copy.path().string(), {"chair.ply"});
}

TEST(RenderSemanticMap, GivesLabelsObjectsAndRooms)
{
  const Copy copy;
  const std::vector<std::string> labels = {"--colour", "label"};
  const std::string of_planes = copy.drawn("top", labels);
  const std::string objects = copy.drawn("objects");
  const std::string slice = copy.drawn("slice");
  writeSemanticMap(copy.run());
  EXPECT_NE(copy.drawn("top", labels), of_planes);
  EXPECT_NE(copy.drawn("slice"), slice) << "rooms are shown";
  const std::vector<std::string> above = {"--height", "1.9", "--thickness", "2"};
  const std::string upstairs = copy.drawn("slice", above);
  for (const char* const name : {"planes.json", "planes.pcd", "objects.json"})
    fs::remove(copy.run() / name);
  EXPECT_EQ(copy.drawn("objects"), objects);
  fs::remove(copy.run() / "semantic_map.pcd");
  pcl6d::test::expectError(
      copy.draw("top", labels), kRender, 1, {"colour label needs", "semantic map"});
  fs::remove(copy.run() / "semantic_map.json");
  EXPECT_EQ(copy.drawn("slice", above), upstairs) << "the room ends at 1.5 m";
}

TEST(RenderSemanticMap, ThatIsBrokenIsAnError)
{
  const Copy copy;
  writeSemanticMap(copy.run());
  pcl::PCLPointCloud2 cloud = roomCloud({0});
  pcl6d::writePcd(copy.run() / "semantic_map.pcd", cloud);
  const auto refuses = [&](const std::vector<std::string>& words) {
    pcl6d::test::expectError(
        copy.draw("top", {"--colour", "label"}), kRender, 1, words);
  };
  refuses({"semantic_map.pcd", "no field label"});
  pcl6d::addField(
      cloud, "label", pcl::PCLPointField::UINT32, std::vector<double>(cloud.width, 77));
  pcl6d::writePcd(copy.run() / "semantic_map.pcd", cloud);
  refuses({"label = 77", "no such label"});
  writeText(copy.run() / "semantic_map.json", "{");
  refuses({"semantic_map.json"});
}
