// SPDX-License-Identifier: BSD-3-Clause
// What pcl_slam6d_objects locate says of input that it cannot use.
#include "apps/objects/located_room.h"

#include <pcl6d/io/mesh_io.h>

#include <functional>
#include <optional>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::kObjectsProgram;
using pcl6d::test::readText;
using pcl6d::test::storedModel;
using pcl6d::test::writeText;
using Words = std::vector<std::string>;

class LocateBadInput : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    room_.emplace();
  }
  static void
  TearDownTestSuite()
  {
    room_.reset();
  }

  std::string
  name(const std::string& file) const
  {
    return folder_ / file;
  }

  static std::string
  scan()
  {
    return room_->sim() / "scan000.pcd";
  }

  /** Expects an error, and that nothing is written. */
  void
  refused(Words arguments, int code, const Words& words) const
  {
    arguments.insert(arguments.begin(), "locate");
    arguments.insert(arguments.end(), {"-o", name("out")});
    pcl6d::test::expectError(pcl6d::test::runProgram(kObjectsProgram, arguments),
                             kObjectsProgram,
                             code,
                             words);
    EXPECT_FALSE(fs::exists(name("out")));
  }

  /** A copy of the chair of the store under a name. */
  std::string
  chairCopy(const std::string& file) const
  {
    fs::copy_file(storedModel("chair") + "/model.ply", name(file));
    return name(file);
  }

  /** A folder of the store with the chair, its model.json changed. */
  std::string
  chairFolder(const std::string& folder,
              const std::function<std::string(std::string)>& change) const
  {
    fs::create_directory(name(folder));
    chairCopy(folder + "/model.ply");
    writeText(name(folder + "/model.json"),
              change(readText(storedModel("chair") + "/model.json")));
    return name(folder);
  }

  static std::optional<pcl6d::test::LocatedRoom> room_;
  pcl6d::test::TempFolder folder_;
};

std::optional<pcl6d::test::LocatedRoom> LocateBadInput::room_;
} // namespace

TEST_F(LocateBadInput, TellsOfModelFilesThatAreNone)
{
  refused({scan()}, 2, {"--model", "--store"});
  refused({scan(), "--model", name("none.ply")}, 1, {"none.ply", "No such file"});
  writeText(name("empty.xyz"), "");
  refused({scan(), "--model", name("empty.xyz")}, 1, {"empty.xyz", "points", "= 0"});
  writeText(name("empty.ply"), "");
  refused({scan(), "--model", name("empty.ply")}, 1, {"empty.ply", "header"});
  writeText(name("line.xyz"), "0 0 0\n1 0 0\n2 0 0\n");
  refused({scan(), "--model", name("line.xyz")}, 1, {"line.xyz", "= 3", ">= 10"});
  pcl6d::TriangleMesh mesh = pcl6d::readMesh(chairCopy("chair.ply"));
  std::string text;
  for (const auto& v : mesh.vertices)
    text += "v " + std::to_string(1000 * v.x()) + " " + std::to_string(1000 * v.y()) +
            " " + std::to_string(1000 * v.z()) + "\n";
  for (const auto& t : mesh.triangles)
    text += "f " + std::to_string(t[0] + 1) + " " + std::to_string(t[1] + 1) + " " +
            std::to_string(t[2] + 1) + "\n";
  writeText(name("mm.obj"), text);
  refused({scan(), "--model", name("mm.obj")}, 1, {"mm.obj", "millimetres", "0.001"});
}

TEST_F(LocateBadInput, TellsOfFoldersOfTheStore)
{
  fs::create_directory(name("empty"));
  refused({scan(), "--model", name("empty")}, 1, {"empty/model.json"});
  refused({scan(), "--store", name("empty")}, 1, {"empty", "model.json"});
  refused({scan(), "--store", name("nowhere")}, 1, {"nowhere"});
  const auto cut = [](const std::string& json) { return json.substr(0, 40); };
  refused({scan(), "--model", chairFolder("cut", cut)},
          1,
          {"cut/model.json: line", "not the syntax of JSON"});
  const auto other = [](const std::string& json) {
    return std::string(json).replace(json.find("model.ply"), 9, "other.ply");
  };
  refused({scan(), "--model", chairFolder("other", other)}, 1, {"other.ply"});
}

TEST_F(LocateBadInput, TellsOfClasses)
{
  const std::string file = chairCopy("chair.ply");
  refused(
      {scan(), "--model", file, storedModel("chair")}, 1, {"two models", "'chair'"});
  refused({scan(), "--model", chairCopy("my chair!.ply")},
          1,
          {"my chair!.ply", "class = \"my chair!\"", "rename the file"});
  for (const char* const odd : {"a b", "=x", "a/b", "-c"})
    refused({scan(), "--model", file, std::string("--class=") + odd},
            2,
            {"--class", "letters"});
  refused({scan(), "--model", file, storedModel("table"), "--class", "stool"},
          2,
          {"--class names one model, but 2"});
}

TEST_F(LocateBadInput, TellsOfCascades)
{
  const auto broken = [](const std::string& json) {
    return std::string(json).replace(
        json.rfind('}'), 1, ", \"cascades\": {\"range\": \"r.xml\"}}");
  };
  const auto bare = [](std::string json) { // without the cascades of the store
    const auto old = json.find("\"cascades\"");
    if (old != std::string::npos)
      json.erase(json.rfind(',', old), json.find('}', old) + 1 - json.rfind(',', old));
    return json;
  };
  refused({scan(), "--model", chairFolder("bare", bare), "--proposals", "cascade"},
          1,
          {"'chair'", "no cascade for this channel", "train", "--proposals clusters"});
  const std::string chair = chairFolder(
      "broken", [&](const std::string& json) { return broken(bare(json)); });
  const Words arguments = {scan(), "--model", chair, "--proposals", "cascade"};
  refused(arguments, 1, {"r.xml"}); // missing
  writeText(chair + "/r.xml", "<?xml version=\"1.0\"?><opencv_storage><cascade>");
  refused(arguments, 1, {"r.xml: line 1", "no XML"});
  writeText(chair + "/r.xml",
            "<?xml version=\"1.0\"?><opencv_storage><cascade "
            "type_id=\"opencv-cascade-classifier\"></cascade></opencv_storage>");
  refused(arguments, 1, {"r.xml"});
}

TEST_F(LocateBadInput, TellsOfScans)
{
  const std::string chair = storedModel("chair");
  refused({name("none.pcd"), "--model", chair}, 1, {"none.pcd", "No such file"});
  fs::create_directory(name("empty"));
  refused({name("empty"), "--model", chair}, 1, {"empty", "no scans found"});
  writeText(name("cut.pcd"), readText(scan()).substr(0, 3000));
  refused({name("cut.pcd"), "--model", chair}, 1, {"cut.pcd", "expected"});
  writeText(name("few.xyz"), "1 0 0\n1 0 0.1\n1 0.1 0\n");
  refused({name("few.xyz"), "--model", chair}, 1, {"few.xyz", "= 3", ">= 10"});
  refused(
      {room_->sim(), "--model", chair, "--first", "7"}, 2, {"--first = 7", "3 scans"});
}

TEST_F(LocateBadInput, TellsOfOptions)
{
  const auto option =
      [&](const std::string& name, const std::string& value, const Words& more = {}) {
        Words words = {"--" + name + " = " + value};
        words.insert(words.end(), more.begin(), more.end());
        refused({scan(), "--model", storedModel("chair"), "--" + name + "=" + value},
                2,
                words);
      };
  option("proposals", "magic", {"auto, clusters, features or cascade"});
  option("rule", "xor", {"and, or, range or reflectance"});
  refused({scan(), "--model", storedModel("chair"), "--format=tiff"},
          2,
          {"--format", "tiff", "xyz"});
  option("up", "x", {"y or z"});
  option("scale", "0", {"> 0"});
  option("min-visible", "1.5", {"0 to 1"});
  option("min-agreement", "-1", {"0 to 1"});
  option("max-violation", "2", {"0 to 1"});
  option("min-support", "0", {"> 0"});
  option("min-range", "-1", {">= 0"});
  option("max-range", "-1", {"min-range"});
  option("threads", "-1", {"0 to 1024"});
  for (const char* const needs_folder : {"first", "last", "every", "poses"})
    refused({scan(),
             "--model",
             storedModel("chair"),
             std::string("--") + needs_folder,
             "1"},
            2,
            {needs_folder, "needs a folder"});
  refused(
      {scan(), "--model", storedModel("chair"), "--separate"}, 2, {"needs a folder"});
  refused(
      {scan(), "--model", storedModel("chair"), "--shape", "round"}, 2, {"--shape"});
}
