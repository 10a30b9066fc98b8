// SPDX-License-Identifier: BSD-3-Clause
#include "scene/body_reader.h"

#include <pcl6d/common/name_table.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_file.h>
#include <pcl6d/simulation/scene_truth.h>

namespace pcl6d {
using namespace simulation;

namespace {
void
readObject(const JsonValue& json, BodyReader& reader, SimulationScene& scene)
{
  const auto object_class = json.get<std::string>("class");
  const TriangleScene shape = reader.readShape(json);
  scene.addObject(object_class, shape, reader.readPose(json));
  std::vector<std::string> known = BodyReader::keysOfShape(json, true);
  known.emplace_back("class");
  json.allow(known);
}

WayEnd
readEnd(const JsonValue& json)
{
  std::string end = "return";
  json.read("end", end);
  constexpr Named<WayEnd> kEnds[] = {{WayEnd::kStop, "stop"},
                                     {WayEnd::kReturn, "return"},
                                     {WayEnd::kClosed, "closed"}};
  if (const auto known = findNamed(kEnds, end))
    return *known;
  json.fail("end", "'" + end + "', but must be " + listed(kEnds, WordList::kOr));
}

void
readMoving(const JsonValue& json, BodyReader& reader, SimulationScene& scene)
{
  MovingBody body;
  body.name = json.get<std::string>("class");
  body.shape = reader.readShape(json);
  body.way = reader.places(json, "way");
  json.read("speed", body.speed);
  json.read("start", body.start);
  body.end = readEnd(json);
  scene.addMoving(std::move(body));
  std::vector<std::string> known = BodyReader::keysOfShape(json, false);
  known.insert(known.end(), {"class", "way", "speed", "start", "end"});
  json.allow(known);
}
} // namespace

SimulationScene
readScene(const std::filesystem::path& path)
{
  const JsonValue json = readJson(path);
  BodyReader reader(path);
  SimulationScene scene;
  scene.name = path.stem().string();
  scene.description = json.dump();
  json.read("name", scene.name);
  json.read("scans", scene.num_scans);
  json.read("max_range", scene.max_range);
  reader.readMaterials(json);
  if (!json.has("bodies"))
    json.fail("key 'bodies' is missing");
  reader.readBodies(json, scene.geometry);
  forEachObject(json, "objects", [&](const JsonValue& object) {
    readObject(object, reader, scene);
  });
  forEachObject(json, "moving", [&](const JsonValue& moving) {
    readMoving(moving, reader, scene);
  });
  scene.waypoints = reader.places(json, "waypoints");
  json.allow({"name",
              "scans",
              "max_range",
              "materials",
              "bodies",
              "objects",
              "moving",
              "waypoints"});
  numberPlanes(scene.geometry);
  return scene;
}

SimulationScene
meshScene(const std::filesystem::path& path,
          const std::vector<Eigen::Vector3d>& waypoints,
          const MeshOptions& options)
{
  SimulationScene scene;
  scene.name = path.stem().string();
  Surface surface{"mesh"};
  surface.is_solid = false;
  addMesh(
      scene.geometry, readMesh(path, options), Eigen::Isometry3d::Identity(), surface);
  scene.waypoints = waypoints;
  return scene;
}

} // namespace pcl6d
