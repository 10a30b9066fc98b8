// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "simulate/scene_options.h"

#include <pcl6d/io/point_list_io.h>
#include <pcl6d/simulation/scene_file.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace pcl6d::app {
namespace {
constexpr const char* kMeshes[] = {".ply", ".obj", ".stl"};

std::string
extensionOf(const std::string& name)
{
  std::string extension = std::filesystem::path(name).extension().string();
  std::transform(extension.begin(),
                 extension.end(),
                 extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool
isMesh(const SceneSettings& s)
{
  const std::string extension = extensionOf(s.name);
  return std::find(std::begin(kMeshes), std::end(kMeshes), extension) !=
         std::end(kMeshes);
}

SimulationScene
loadMesh(const SceneSettings& s)
{
  if (s.path.empty())
    throw UsageError("--path is missing: the waypoints of the robot through the mesh " +
                     s.name);
  MeshOptions options;
  options.scale = s.scale;
  options.up = s.up;
  return meshScene(s.name, readPointList(s.path), options);
}

SimulationScene
loadWhole(const SceneSettings& s, std::uint64_t seed)
{
  if (isMesh(s))
    return loadMesh(s);
  if (!s.path.empty())
    throw UsageError("--path is for meshes only; " + s.name + " has its own way");
  if (extensionOf(s.name) == ".json")
    return readScene(s.name);
  SimulationScene scene;
  checkOptions([&] { scene = builtInScene(s.name, seed); });
  return scene;
}
} // namespace

std::string
sceneList()
{
  std::string list;
  for (const auto& name : builtInSceneNames())
    list += "\n  " + name + ": " + builtInSceneDescription(name);
  return list;
}

void
addScene(OptionTable& table, SceneSettings& s)
{
  table.group("Scene");
  table.add("path FILE", &s.path)
      .help("of a mesh: lines x y z, the waypoints of the robot on the floor, closed "
            "from the last to the first");
  table.add("scale", &s.scale)
      .above(0, "> 0")
      .help("of a mesh: [m] per unit of the file");
  table.add("up", &s.up, {{"y", UpAxis::kY}, {"z", UpAxis::kZ}})
      .help("of a mesh: y|z, the upward axis");
  table.add("labels", &s.labels, {{"auto", std::nullopt}, {"yes", true}, {"no", false}})
      .help("yes|no|auto: points carry plane_id, object_id and label, and "
            "planes_truth.json and objects_truth.json are written; auto: not for "
            "corridor");
  table.add("without CLASS", &s.without)
      .composing()
      .help("leaves out the objects of a class, for example chair; may be repeated");
}

SimulationScene
loadScene(const SceneSettings& s, std::uint64_t seed)
{
  SimulationScene scene = loadWhole(s, seed);
  return s.without.empty() ? scene : withoutObjects(scene, s.without);
}

bool
wantsLabels(const SceneSettings& s)
{
  // Others compare with the bytes of corridor, which therefore stay unchanged.
  return s.labels.value_or(s.name != "corridor");
}

void
describeScene(const SceneSettings& s,
              const SimulationScene& scene,
              nlohmann::ordered_json& json)
{
  if (isMesh(s)) {
    json["mesh"] = {{"scale", s.scale}, {"up", s.up == UpAxis::kY ? "y" : "z"}};
    nlohmann::ordered_json waypoints;
    for (const auto& p : scene.waypoints)
      waypoints.push_back({p.x(), p.y(), p.z()});
    json["waypoints"] = waypoints;
  }
  if (!s.without.empty())
    json["without"] = s.without;
  if (!scene.description.empty())
    json["description"] = nlohmann::ordered_json::parse(scene.description);
}

} // namespace pcl6d::app
