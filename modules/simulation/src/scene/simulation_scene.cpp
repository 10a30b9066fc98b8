// SPDX-License-Identifier: BSD-3-Clause
#include "built_in/built_in_scenes.h"
#include "built_in/worlds.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/late_library.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/scene_truth.h>
#include <pcl6d/simulation/simulation_scene.h>

#include <algorithm>
#include <array>

namespace pcl6d {
using namespace simulation;

namespace {
struct Entry {
  const char* name;
  const char* description;
};
constexpr std::array<Entry, 11> kScenes = {
    {{"corridor", "four furnished rooms, four corridors, two ramps; a loop of 55 m"},
     {"campus",
      "streets between houses on hilly ground, with trees, parked cars, people and "
      "lamps; a way of 1 km with five loops"},
     {"crowd",
      "a square between houses where people walk and cars drive; a loop of 80 m"},
     {"glass",
      "offices with glass partitions that return one ray in five; a loop of 50 m"},
     {"mine",
      "a drift with rough rock, timber supports and boulders; a loop of 130 m, "
      "climbing and falling"},
     {"multilevel",
      "two storeys, joined by a ramp and by stairs; a loop of 120 m over both"},
     {"parking",
      "an underground car park, symmetric under half a turn except for three vans, a "
      "door and a pipe; a loop of 100 m"},
     {"rooms",
      "a flat: rooms with tables, chairs and shelves along a hall, doors open and "
      "closed; another seed is another flat"},
     {"shelves",
      "a storage hall: rows of shelves with bays repeating every metre; a loop of 90 "
      "m"},
     {"tunnel",
      "a straight tunnel without any feature along the axis, with ends out of sight; "
      "out and back, 115 m"},
     {"twins",
      "four rooms along a corridor, equal to the last chair; a loop of 70 m through "
      "the rooms"}}};

const Entry&
entryOf(const std::string& name)
{
  std::string known;
  for (const auto& scene : kScenes) {
    if (name == scene.name)
      return scene;
    known += std::string(known.empty() ? "" : ", ") + scene.name;
  }
  throw BadArgument("no scene '" + name + "'; known: " + known);
}

/** \return the scene of an entry, planes not yet numbered */
SimulationScene
make(const std::string& name, std::uint64_t seed)
{
  if (name == kScenes.front().name)
    return corridorScene(seed);
#ifdef PCL6D_LATE_LIBRARIES
  const auto worlds = reinterpret_cast<decltype(&pcl6d_simulation_worlds)>(
      symbolOfLateLibrary("world '" + name + "'",
                          "pcl6d_simulation_worlds",
                          "pcl6d_simulation_worlds"));
#else
  const auto worlds = &pcl6d_simulation_worlds;
#endif
  SimulationScene scene;
  worlds(name.c_str(), seed, scene);
  return scene;
}

/** New ids of objects by old ids, both from 1; 0: removed. */
using NewIds = std::vector<std::uint32_t>;

bool
isGone(const Surface& surface, const NewIds& ids)
{
  return surface.object != 0 && ids[surface.object] == 0;
}

/** \return the remaining triangles and surfaces; unused vertices are kept */
TriangleScene
subset(const TriangleScene& scene, const NewIds& ids)
{
  TriangleScene left;
  left.vertices = scene.vertices;
  std::vector<std::uint32_t> place(scene.surfaces.size(), 0);
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    if (isGone(scene.surfaces[i], ids))
      continue;
    place[i] = left.addSurface(scene.surfaces[i]);
    left.surfaces.back().object = ids[scene.surfaces[i].object];
  }
  for (const auto& triangle : scene.triangles)
    if (!isGone(scene.surfaces[triangle.surface], ids))
      left.triangles.push_back({triangle.vertices, place[triangle.surface]});
  return left;
}
} // namespace

namespace {
ObjectPose
objectPose(const std::string& object_class,
           const TriangleScene& shape,
           const Eigen::Isometry3d& T_scene_object)
{
  ObjectPose object;
  object.object_class = object_class;
  object.T_world_object = T_scene_object;
  object.box.setEmpty();
  for (const auto& vertex : shape.vertices)
    object.box.extend(vertex);
  return object;
}
} // namespace

std::uint32_t
SimulationScene::addObject(const std::string& object_class,
                           const TriangleScene& shape,
                           const Eigen::Isometry3d& T_scene_object)
{
  objects.push_back(objectPose(object_class, shape, T_scene_object));
  const auto id = static_cast<std::uint32_t>(objects.size());
  const std::size_t first = geometry.surfaces.size();
  addModel(geometry, shape, T_scene_object, id);
  for (std::size_t i = first; i < geometry.surfaces.size(); ++i)
    if (geometry.surfaces[i].name == Surface().name) // errors name the blocking surface
      geometry.surfaces[i].name = object_class;
  return id;
}

std::uint32_t
SimulationScene::addMoving(MovingBody body)
{
  body.validate();
  objects.push_back(objectPose(body.name, body.shape, body.poseAt(0)));
  objects.back().moves = true;
  const auto id = static_cast<std::uint32_t>(objects.size());
  for (auto& surface : body.shape.surfaces)
    surface.object = id;
  moving.push_back(std::move(body));
  return id;
}

std::vector<ObjectPose>
sceneObjects(const SimulationScene& scene, const Eigen::Isometry3d& T_scene_world)
{
  std::vector<ObjectPose> objects = scene.objects;
  for (auto& object : objects)
    object.T_world_object = T_scene_world.inverse() * object.T_world_object;
  return objects;
}

std::vector<std::string>
builtInSceneNames()
{
  std::vector<std::string> names;
  for (const auto& scene : kScenes)
    names.emplace_back(scene.name);
  return names;
}

std::string
builtInSceneDescription(const std::string& name)
{
  return entryOf(name).description;
}

SimulationScene
builtInScene(const std::string& name, std::uint64_t seed)
{
  SimulationScene scene = make(entryOf(name).name, seed);
  numberPlanes(scene.geometry);
  return scene;
}

SimulationScene
withoutObjects(const SimulationScene& scene, const std::vector<std::string>& classes)
{
  SimulationScene left = scene;
  left.objects.clear();
  NewIds ids{0};
  for (const auto& object : scene.objects) {
    const bool stays =
        std::find(classes.begin(), classes.end(), object.object_class) == classes.end();
    if (stays)
      left.objects.push_back(object);
    ids.push_back(stays ? static_cast<std::uint32_t>(left.objects.size()) : 0);
  }
  left.geometry = subset(scene.geometry, ids);
  numberPlanes(left.geometry);
  left.moving.clear();
  for (auto body : scene.moving) {
    body.shape = subset(body.shape, ids);
    if (!body.shape.triangles.empty())
      left.moving.push_back(std::move(body));
  }
  return left;
}

} // namespace pcl6d
