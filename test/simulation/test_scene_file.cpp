// SPDX-License-Identifier: BSD-3-Clause
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/simulation/scene_file.h>
#include <pcl6d/simulation/scene_truth.h>
#include <pcl6d/simulation/simulator.h>
#include <pcl6d/simulation/terrain.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace {
using pcl6d::readScene;
using pcl6d::SimulationScene;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

constexpr const char* kYard = R"({
  "name": "yard", "scans": 12, "max_range": 40,
  "materials": {"brick": {"reflectance": 0.4, "label": "wall"},
                "oak": {"reflectance": 0.5, "label": "door"},
                "stone": {"reflectance": 0.3, "label": "floor"}},
  "bodies": [
    {"type": "box", "material": "stone", "centre": [0, 0, -0.1], "size": [40, 40, 0.2]},
    {"type": "wall", "material": "brick", "from": [-8, 8], "to": [8, 8], "top": 3,
     "thickness": 0.3, "openings": [{"begin": 1, "end": 2, "high": 2, "leaf": "oak"},
                                    {"begin": 4, "end": 6, "low": 1, "high": 2}]},
    {"type": "ramp", "from": [10, 0], "to": [14, 0], "width": 2, "to_height": 1,
     "from_height": 0.1, "bottom": -0.1},
    {"type": "stairs", "from": [10, 4], "to": [12, 4], "to_height": 1.2, "steps": 4},
    {"type": "cylinder", "foot": [-9, 0, 0], "radius": 0.3, "height": 4},
    {"type": "revolved", "foot": [-9, 4, 0], "profile": [[1, 0], [0.2, 2]], "segments": 9},
    {"type": "model", "file": "wedge.obj", "position": [-9, -4, 0], "yaw": 1.2}
  ],
  "objects": [
    {"class": "table", "position": [0, 1, 0], "yaw": 0.5,
     "bodies": [{"type": "box", "centre": [0, 0, 0.7], "size": [1, 2, 0.1]}]},
    {"class": "wedge", "file": "wedge.obj", "scale": 0.5, "position": [1, -1, 0]}
  ],
  "moving": [{"class": "person", "way": [[6, -6, 0], [6, 6, 0]], "speed": 1.2,
              "end": "stop", "start": 2,
              "bodies": [{"type": "cylinder", "foot": [0, 0, 0], "radius": 0.2,
                          "height": 1.7}]}],
  "waypoints": [[-4, -4, 0], [4, -4, 0], [4, 4, 0], [-4, 4, 0]]
})";
constexpr const char* kWedge = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                               "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string
replaced(std::string text, const std::string& what, const std::string& by)
{
  return text.replace(text.find(what), what.size(), by);
}

class SceneFile : public testing::Test {
protected:
  SceneFile() { writeText(folder_ / "wedge.obj", kWedge); }

  SimulationScene
  read(const std::string& text)
  {
    writeText(file_, text);
    return readScene(file_);
  }

  // Expects the message "FILE: message".
  void
  expectRefused(const std::string& text, const std::string& message)
  {
    try {
      read(text);
      ADD_FAILURE() << "accepted, but expected: " << message;
    } catch (const pcl6d::IoFailed& e) {
      EXPECT_EQ(e.what(), file_.string() + ": " + message);
    }
  }

  const TempFolder folder_;
  const std::filesystem::path file_ = folder_ / "yard.json";
};
} // namespace

TEST_F(SceneFile, HoldsGlass)
{
  const auto most = [](const SimulationScene& scene) {
    double transmittance = 0;
    for (const auto& surface : scene.geometry.surfaces)
      transmittance = std::max(transmittance, surface.transmittance);
    return transmittance;
  };
  EXPECT_EQ(most(read(kYard)), 0);
  EXPECT_EQ(most(read(replaced(kYard,
                               "\"reflectance\": 0.4",
                               "\"reflectance\": 0.1, \"transmittance\": 0.7"))),
            0.7);
}

TEST_F(SceneFile, HoldsAllKindsOfBodies)
{
  const SimulationScene scene = read(kYard);
  scene.geometry.validate();
  EXPECT_EQ(scene.name, "yard");
  EXPECT_EQ(scene.num_scans, 12);
  EXPECT_EQ(scene.max_range, 40);
  EXPECT_EQ(scene.waypoints.size(), 4u);
  ASSERT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(scene.objects[0].object_class, "table");
  EXPECT_LT((scene.objects[0].box.sizes() - Eigen::Vector3d(1, 2, 0.1)).norm(), 1e-12);
  EXPECT_LT((scene.objects[1].box.sizes() - Eigen::Vector3d::Constant(0.5)).norm(),
            1e-12);
  ASSERT_EQ(scene.moving.size(), 1u);
  EXPECT_EQ(scene.moving[0].speed, 1.2);
  EXPECT_EQ(scene.moving[0].start, 2);
  EXPECT_EQ(scene.moving[0].end, pcl6d::WayEnd::kStop);
  EXPECT_TRUE(scene.objects[2].moves);
  EXPECT_EQ(scene.moving[0].shape.surfaces[0].object, 3u);

  const auto planes = scenePlanes(scene.geometry);
  const auto count = [&](const char* label) {
    return std::count_if(planes.begin(), planes.end(), [label](const auto& plane) {
      return plane.label == label;
    });
  };
  EXPECT_EQ(count("floor"), 1);
  EXPECT_EQ(count("door"), 4); // two faces, two edges of 0.2 m^2
  EXPECT_GE(count("wall"), 2);
  const auto wall = std::find_if(planes.begin(), planes.end(), [](const auto& plane) {
    return plane.label == "wall" && plane.area > 10;
  });
  ASSERT_NE(wall, planes.end());
  EXPECT_NEAR(wall->area, 16 * 3 - 1 * 2 - 2 * 1, 1e-9);
}

TEST_F(SceneFile, CanBeSimulated)
{
  pcl6d::SimulationOptions options;
  options.num_scans = 12;
  const SimulationScene scene = read(kYard);
  const pcl6d::Simulator simulator(scene, options);
  bool sees_person = false;
  for (std::size_t i = 0; i < simulator.size(); ++i)
    for (const auto& sample : simulator.rangeScan(i).samples) {
      const auto& all = simulator.scene().scene();
      sees_person |= std::isfinite(sample.range) &&
                     all.surfaces[all.triangles[sample.triangle].surface].object == 3;
    }
  EXPECT_TRUE(sees_person);
}

TEST_F(SceneFile, PutsPlacesOfTwoNumbersOnTheTerrain)
{
  const SimulationScene scene = read(R"({
    "bodies": [{"type": "terrain", "low": [-20, -20], "high": [20, 20], "amplitude": 2,
                "wavelength": 10, "slope": [0.1, 0], "seed": 5}],
    "objects": [{"class": "post", "position": [3, 4],
                 "bodies": [{"type": "box", "centre": [0, 0, 1], "size": [0.1, 0.1, 2]}]}],
    "waypoints": [[-4, -4], [0, -4], [4, -4], [4, 4], [-4, 4]]})");
  pcl6d::TerrainOptions options;
  options.low = {-20, -20};
  options.high = {20, 20};
  options.amplitude = 2;
  options.wavelength = 10;
  options.slope = {0.1, 0};
  options.seed = 5;
  const pcl6d::Terrain terrain(options);
  EXPECT_EQ(scene.waypoints[1].z(), terrain.height({0, -4}));
  EXPECT_EQ(scene.objects[0].T_world_object.translation().z(), terrain.height({3, 4}));
  EXPECT_NE(scene.waypoints[1].z(), 0);
}

TEST_F(SceneFile, NamesWhatIsWrongAndWhere)
{
  expectRefused(replaced(kYard, "\"thickness\"", "\"thikness\""),
                "/bodies/1: unknown key 'thikness'");
  expectRefused(replaced(kYard, "\"scans\"", "\"scan\""), "/: unknown key 'scan'");
  expectRefused(replaced(kYard, "\"leaf\": \"oak\"", "\"leaves\": 1"),
                "/bodies/1/openings/0: unknown key 'leaves'");
  expectRefused(
      replaced(kYard, "\"label\": \"door\"", "\"label\": \"gate\""),
      "/materials/oak/label: 'gate', but must be none, floor, ceiling, wall or "
      "door");
  expectRefused(replaced(kYard, "\"reflectance\": 0.4", "\"reflectance\": 4"),
                "/materials/brick/reflectance: 4.000000, but must be in [0, 1]");
  expectRefused(replaced(kYard, "\"reflectance\": 0.4", "\"transmittance\": -0.5"),
                "/materials/brick/transmittance: -0.500000, but must be in [0, 1]");
  expectRefused(replaced(kYard, "\"material\": \"stone\"", "\"material\": \"mud\""),
                "/bodies/0/material: no material 'mud' in /materials");
  expectRefused(
      replaced(kYard, "\"type\": \"ramp\"", "\"type\": \"slide\""),
      "/bodies/2/type: 'slide', but must be box, wall, ramp, stairs, cylinder, "
      "revolved, terrain or model");
  expectRefused(replaced(kYard, "[40, 40, 0.2]", "[40, 40]"),
                "/bodies/0/size: expected 3 numbers, got 2");
  expectRefused(replaced(kYard, "[40, 40, 0.2]", "[40, 40, \"x\"]"),
                "/bodies/0/size/2: \"x\" is not a number");
  expectRefused(replaced(kYard, "[40, 40, 0.2]", "[40, 40, 0]"),
                "/bodies/0: size of a box = 40 40  0, but must be > 0");
  expectRefused(replaced(kYard, "\"radius\": 0.3, ", ""),
                "/bodies/4: key 'radius' is missing");
  expectRefused(replaced(kYard, "\"begin\": 4", "\"begin\": 1"),
                "/bodies/1: begin of an opening = 1, but must be after the last one");
  expectRefused(replaced(kYard, "\"end\": \"stop\"", "\"end\": \"crash\""),
                "/moving/0/end: 'crash', but must be stop, return or closed");
  expectRefused(
      replaced(kYard, "[[-4, -4, 0], ", "[[-4, -4], "),
      "/waypoints: 2 numbers are a place on the terrain, but the scene has no terrain");
  expectRefused(replaced(kYard, "\"steps\": 4", "\"steps\": 4.5"),
                "/bodies/3/steps: 4.5 is not a whole number up to a million");
}

TEST_F(SceneFile, RefusesTerrainsThatTakeMoreMemoryThanTheFileIsWorth)
{
  const auto scene = [](const std::string& high) {
    return R"({"bodies": [{"type": "terrain", "low": [0, 0], "high": [10, 10]},
      {"type": "terrain", "low": [0, 0], "high": )" +
           high + R"(}], "waypoints": [[0, 0], [1, 1]]})";
  };
  expectRefused(
      scene("[100, 65535]"),
      "/bodies/1: cell = 1, but must be larger: the rectangle would have more than "
      "2 million cells");
  expectRefused(scene("[1000, 2000]"),
                "/bodies/1/cell: too small: the terrains together would have more than "
                "2 million");
}

TEST_F(SceneFile, NamesWhatIsNoDescriptionAtAll)
{
  expectRefused("{\n\"bodies\": [\n}", "line 3: not the syntax of JSON");
  expectRefused("[1, 2]", "/: [1,2] is no object {...}");
  expectRefused("{}", "/: key 'bodies' is missing");
  expectRefused(R"({"bodies": []})", "/: key 'waypoints' is missing");
  expectRefused(R"({"bodies": {}, "waypoints": []})", "/bodies: {} is no array [...]");
  EXPECT_THROW(readScene(folder_ / "missing.json"), pcl6d::IoFailed);
}

TEST_F(SceneFile, NamesTheMeshThatIsWrong)
{
  writeText(folder_ / "wedge.obj", "v 0 0 0\nv 1 0 0\nf 1 2 2\n");
  try {
    read(kYard);
    FAIL() << "accepted";
  } catch (const pcl6d::IoFailed& e) {
    EXPECT_EQ(e.what(),
              (folder_ / "wedge.obj").string() +
                  ": triangle 1: area is zero, but must be > 0");
  }
}

TEST_F(SceneFile, OfAMeshIsDrivenThrough)
{
  writeText(
      folder_ / "floor.obj",
      "v -10 -10 0\nv 10 -10 0\nv 10 10 0\nv -10 10 0\nv 0 0 3\nf 1 2 3 4\nf 1 2 5\n");
  const SimulationScene scene = pcl6d::meshScene(
      folder_ / "floor.obj", {{-4, 0, 0}, {4, 0, 0}, {4, 4, 0}, {-4, 4, 0}});
  pcl6d::SimulationOptions options;
  options.num_scans = 3;
  EXPECT_EQ(pcl6d::Simulator(scene, options).size(), 3u);
  EXPECT_TRUE(scenePlanes(scene.geometry).empty());
}
