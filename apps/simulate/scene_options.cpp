// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "simulate/scene_options.h"

#include <pcl6d/common/require.h>
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
isMesh(const SceneWords& words)
{
  const std::string extension = extensionOf(words.name);
  return std::find(std::begin(kMeshes), std::end(kMeshes), extension) !=
         std::end(kMeshes);
}

SimulationScene
loadMesh(const SceneWords& words)
{
  if (words.path.empty())
    throw UsageError("--path is missing: the waypoints of the robot through the mesh " +
                     words.name);
  MeshOptions options;
  options.scale = words.scale;
  options.up = words.up == "y" ? UpAxis::kY : UpAxis::kZ;
  return meshScene(words.name, readPointList(words.path), options);
}

SimulationScene
loadWhole(const SceneWords& words, std::uint64_t seed)
{
  checkOptions([&] {
    require(words.up == "y" || words.up == "z", "up", words.up, "y or z");
    require(words.scale > 0, "scale", words.scale, "> 0");
    require(words.labels == "auto" || words.labels == "yes" || words.labels == "no",
            "labels",
            words.labels,
            "auto, yes or no");
  });
  if (isMesh(words))
    return loadMesh(words);
  if (!words.path.empty())
    throw UsageError("--path is for meshes only; " + words.name + " has its own way");
  if (extensionOf(words.name) == ".json")
    return readScene(words.name);
  SimulationScene scene;
  checkOptions([&] { scene = builtInScene(words.name, seed); });
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
describeScene(CommandLine& line, SceneWords& words)
{
  namespace po = boost::program_options;
  line.group("Scene").add_options() //
      ("path",
       po::value(&words.path)->value_name("FILE"),
       "of a mesh: lines x y z, the waypoints of the robot on the floor, closed from "
       "the last to the first")                                              //
      ("scale", valueOf(words.scale), "of a mesh: [m] per unit of the file") //
      ("up", valueOf(words.up), "of a mesh: y|z, the axis that points up")   //
      ("labels",
       valueOf(words.labels),
       "yes|no|auto: points carry plane_id, object_id and label, and "
       "planes_truth.json and objects_truth.json are written; auto: not for "
       "corridor") //
      ("without",
       po::value(&words.without)->value_name("CLASS")->composing(),
       "leaves out the objects of a class, such as chair; may be repeated");
}

SimulationScene
loadScene(const SceneWords& words, std::uint64_t seed)
{
  SimulationScene scene = loadWhole(words, seed);
  return words.without.empty() ? scene : withoutObjects(scene, words.without);
}

bool
wantsLabels(const SceneWords& words)
{
  // The bytes of corridor, which others compare with, stay as they are.
  return words.labels == "yes" || (words.labels == "auto" && words.name != "corridor");
}

void
describeScene(const SceneWords& words,
              const SimulationScene& scene,
              nlohmann::ordered_json& json)
{
  if (isMesh(words)) {
    json["mesh"] = {{"scale", words.scale}, {"up", words.up}};
    nlohmann::ordered_json waypoints;
    for (const auto& p : scene.waypoints)
      waypoints.push_back({p.x(), p.y(), p.z()});
    json["waypoints"] = waypoints;
  }
  if (!words.without.empty())
    json["without"] = words.without;
  if (!scene.description.empty())
    json["description"] = nlohmann::ordered_json::parse(scene.description);
}

} // namespace pcl6d::app
