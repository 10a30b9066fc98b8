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
readObject(JsonObject& json, BodyReader& reader, SimulationScene& scene)
{
  const auto object_class = json.get<std::string>("class");
  const TriangleScene shape = reader.readShape(json);
  scene.addObject(object_class, shape, reader.readPose(json));
}

WayEnd
readEnd(JsonObject& json)
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
readMoving(JsonObject& json, BodyReader& reader, SimulationScene& scene)
{
  MovingBody body;
  body.name = json.get<std::string>("class");
  body.shape = reader.readShape(json);
  json.require("way");
  body.way = reader.places(json, "way");
  json.read("speed", body.speed);
  json.read("start", body.start);
  body.end = readEnd(json);
  scene.addMoving(std::move(body));
}
} // namespace

SimulationScene
readScene(const std::filesystem::path& path)
{
  const JsonValue json = readJson(path);
  JsonObject root(json);
  BodyReader reader(path);
  SimulationScene scene;
  scene.name = path.stem().string();
  scene.description = json.dump();
  root.read("name", scene.name);
  root.read("scans", scene.num_scans);
  root.read("max_range", scene.max_range);
  reader.readMaterials(root);
  root.require("bodies");
  reader.readBodies(root, scene.geometry);
  root.eachObject("objects",
                  [&](JsonObject& object) { readObject(object, reader, scene); });
  root.eachObject("moving",
                  [&](JsonObject& moving) { readMoving(moving, reader, scene); });
  root.require("waypoints");
  scene.waypoints = reader.places(root, "waypoints");
  root.finish();
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
