// SPDX-License-Identifier: BSD-3-Clause
#include "../support/temp_folder.h"
#include "support/folders.h"

#include <pcl6d/common/error.h>
#include <pcl6d/object_localization/model_store.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_builder.h>
#include <pcl6d/simulation/simulation_scene.h>

#include <gtest/gtest.h>

#include <fstream>

namespace pcl6d {
namespace {
namespace fs = std::filesystem;
const fs::path kStore = fs::path(PCL6D_SOURCE_DIR) / "share" / "models";

/** A folder of the store that a test may spoil. */
class ModelStore : public testing::Test {
protected:
  void
  SetUp() override
  {
    fs::copy_file(kStore / "box" / "model.ply", folder() / "model.ply");
  }

  fs::path
  folder() const
  {
    return temp_.path();
  }

  void
  write(const std::string& json) const
  {
    std::ofstream(folder() / "model.json") << json;
  }

  /** \return what is said of a folder with this model.json, without the file's name */
  std::string
  refusal(const std::string& json) const
  {
    write(json);
    return refusalOf(folder());
  }

  static std::string
  refusalOf(const fs::path& path)
  {
    try {
      readStoredModel(path);
    } catch (const IoFailed& e) {
      const std::string message = e.what();
      EXPECT_EQ(message.find(path.string()), 0u) << message;
      return message;
    }
    return "nothing";
  }

  test::TempFolder temp_;
};

void
expectEnds(const std::string& text, const std::string& end)
{
  EXPECT_TRUE(text.size() >= end.size() &&
              text.compare(text.size() - end.size(), end.size(), end) == 0)
      << text;
}

/** \return the largest distance of a vertex of a to the nearest of b */
double
farthest(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b)
{
  double largest = 0;
  for (const auto& p : a) {
    double nearest = 1e9;
    for (const auto& q : b)
      nearest = std::min(nearest, (p - q).norm());
    largest = std::max(largest, nearest);
  }
  return largest;
}
} // namespace

TEST_F(ModelStore, ReadsWhatAFolderTells)
{
  std::ofstream(folder() / "r.xml") << "x";
  write(R"({"schema_version": 1, "class": "crate", "file": "model.ply", "scale": 0.5,
            "up": "y", "cascades": {"range": "r.xml"}})");
  const StoredModel stored = readStoredModel(folder());
  EXPECT_EQ(stored.model.objectClass(), "crate");
  EXPECT_EQ(stored.model.symmetry().turns, 1);
  EXPECT_EQ(stored.mesh.vertices.size(), 8u);
  EXPECT_TRUE(stored.has_mesh);
  EXPECT_EQ(stored.range_cascade, folder() / "r.xml");
  EXPECT_FALSE(stored.reflectance_cascade);
  // 0.4 x 0.6 x 0.45 in its file, whose y points up.
  const Eigen::Vector3d size = stored.model.box().sizes();
  EXPECT_NEAR(size.x(), 0.2, 1e-6);
  EXPECT_NEAR(size.y(), 0.225, 1e-6);
  EXPECT_NEAR(size.z(), 0.3, 1e-6);
}

TEST_F(ModelStore, ReadsSingleMeshesAndClouds)
{
  const StoredModel mesh = readStoredModel(folder() / "model.ply");
  EXPECT_EQ(mesh.model.objectClass(), "model");
  EXPECT_TRUE(mesh.has_mesh);
  std::ofstream cloud(folder() / "cloud.xyz");
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < 20; ++k)
      cloud << 10 * i << ' ' << 10 * k << " 0\n"; // millimetres
  cloud.close();
  ModelFileOptions options;
  options.units.scale = 0.001;
  options.object_class = "board";
  const StoredModel board = readModelFile(folder() / "cloud.xyz", options);
  EXPECT_EQ(board.model.objectClass(), "board");
  EXPECT_FALSE(board.has_mesh);
  EXPECT_FALSE(board.mesh.triangles.empty());
  EXPECT_NEAR(board.model.box().sizes().x(), 0.19, 1e-6);
  expectEnds(refusalOf(folder() / "cloud.xyz"),
             "m: for a model in millimetres use the scale 0.001");
}

TEST_F(ModelStore, TellsWhatIsWrongAndWhere)
{
  const std::string json = (folder() / "model.json").string();
  expectEnds(refusalOf(folder()), "model.json: No such file or directory");
  expectEnds(refusal("{"), "line 1: not the syntax of JSON");
  expectEnds(refusal("[]"), "model.json: /: [] is no object {...}");
  EXPECT_EQ(refusal(R"({"class": "a"})"), json + ": /: key 'file' is missing");
  EXPECT_EQ(refusal(R"({"file": "model.ply"})"), json + ": /: key 'class' is missing");
  EXPECT_EQ(refusal(R"({"class": "a", "file": "other.ply"})"),
            json + ": /file: no file 'other.ply' in " + folder().string());
  expectEnds(refusal(R"({"class": "a", "file": ""})"), "in " + folder().string());
  EXPECT_EQ(refusal(R"({"class": 7, "file": "model.ply"})"),
            json + ": /class: 7 is not a text \"...\"");
  EXPECT_EQ(refusal(R"({"class": "a", "file": "model.ply", "colour": "red"})"),
            json + ": /: unknown key 'colour'");
  EXPECT_EQ(
      refusal(
          R"({"class": "a", "file": "model.ply", "cascades": {"depth": "model.ply"}})"),
      json + ": /cascades: unknown key 'depth'");
  EXPECT_EQ(
      refusal(R"({"class": "a", "file": "model.ply", "cascades": {"range": "r.xml"}})"),
      json + ": /cascades/range: no file 'r.xml' in " + folder().string());
  expectEnds(refusal(R"({"class": "a", "file": "model.ply", "scale": 0})"),
             "but must be > 0");
  expectEnds(refusal(R"({"class": "a", "file": "model.ply", "up": "x"})"),
             "/up: 'x', but must be y or z");
  expectEnds(refusal(R"({"class": "a", "file": "model.ply", "schema_version": 2})"),
             "/schema_version: 2, but must be 1");
  expectEnds(refusal(R"({"class": "a", "file": "model.ply", "scale": 1000})"),
             "m: for a model in millimetres use the scale 0.001");
  std::ofstream(folder() / "model.ply") << "no mesh";
  EXPECT_NE(refusal(R"({"class": "a", "file": "model.ply"})").find("model.ply"),
            std::string::npos);
}

TEST_F(ModelStore, BelievesOnlyASymmetryThatTheMeshHas)
{
  const auto with = [](const std::string& symmetry) {
    return R"({"class": "a", "file": "model.ply", "symmetry": ")" + symmetry + "\"}";
  };
  write(with("turn:2"));
  EXPECT_EQ(readStoredModel(folder()).model.symmetry().turns, 2);
  for (const char* symmetry : {"turn:4", "turn:3", "round"})
    EXPECT_NE(refusal(with(symmetry)).find("off itself"), std::string::npos)
        << symmetry;
  for (const char* symmetry : {"", "turn", "turn:1", "turn:65", "turn:-2", "Round"})
    expectEnds(refusal(with(symmetry)), "none, round, or turn:2 to turn:64");
}

TEST_F(ModelStore, RefusesClassesThatQueriesCannotName)
{
  for (const char* name : {"chair", "T-800", "v1.2_b", "Stühle", "椅子", "9"})
    EXPECT_NO_THROW(checkObjectClass(name)) << name;
  const std::string too_long(65, 'a');
  for (const char* name : {"",
                           "a b",
                           "-a",
                           ".",
                           "a/b",
                           "a\"b",
                           "a\nb",
                           "a=b",
                           "\xff",
                           "a\xc3",
                           "../a",
                           too_long.c_str()})
    EXPECT_THROW(checkObjectClass(name), BadArgument) << name;
  expectEnds(
      refusal(R"({"class": "a b", "file": "model.ply"})"),
      "/class: class = \"a b\", but must be 1 to 64 letters, digits, '-', '_' and "
      "'.', the first a letter or a digit");
  fs::copy_file(folder() / "model.ply", folder() / "milk (2).ply");
  EXPECT_NE(refusalOf(folder() / "milk (2).ply").find("class = \"milk (2)\""),
            std::string::npos);
}

TEST_F(ModelStore, ListsItsFoldersByName)
{
  EXPECT_THROW(listModels(folder()), IoFailed);
  EXPECT_THROW(listModels(folder() / "missing"), IoFailed);
  std::vector<std::string> names;
  for (const auto& path : listModels(kStore))
    names.push_back(path.filename());
  EXPECT_EQ(names,
            (std::vector<std::string>{"bin", "box", "chair", "person", "table"}));
}

TEST(ShippedModels, StandOnTheirFeetInTheMiddle)
{
  for (const auto& path : listModels(kStore)) {
    const StoredModel stored = readStoredModel(path);
    EXPECT_EQ(stored.model.objectClass(), path.filename());
    const Eigen::AlignedBox3d& box = stored.model.box();
    EXPECT_NEAR(box.min().z(), 0, 1e-6) << path;
    EXPECT_LT(box.center().head<2>().norm(), 1e-3) << path;
    EXPECT_LT(fs::file_size(path / "model.ply"), 20000u) << path;
  }
}

TEST(ShippedModels, ChairIsThatOfTheRooms)
{
  const SimulationScene rooms = builtInScene("rooms", 1);
  const StoredModel stored = readStoredModel(kStore / "chair");
  for (std::uint32_t i = 0; i < rooms.objects.size(); ++i) {
    if (rooms.objects[i].object_class != "chair")
      continue;
    const Eigen::Isometry3d T_object_scene = rooms.objects[i].T_world_object.inverse();
    std::vector<Eigen::Vector3d> corners;
    for (const auto& triangle : rooms.geometry.triangles)
      if (rooms.geometry.surfaces[triangle.surface].object == i + 1)
        for (const auto vertex : triangle.vertices)
          corners.push_back(T_object_scene * rooms.geometry.vertices[vertex]);
    EXPECT_LT(farthest(corners, stored.mesh.vertices), 1e-9);
    EXPECT_LT(farthest(stored.mesh.vertices, corners), 1e-9);
    return;
  }
  FAIL() << "no chair in the rooms";
}

TEST(ShippedModels, PersonIsRoundAndOfAverageHeight)
{
  const StoredModel person = readStoredModel(kStore / "person");
  EXPECT_TRUE(person.model.symmetry().isRound());
  EXPECT_NEAR(person.model.box().sizes().z(), 1.75, 1e-6);
}

} // namespace pcl6d
