// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/random.h>
#include <pcl6d/object_localization/model_store.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/simulation/cast_scan.h>
#include <pcl6d/simulation/scene_bodies.h>
#include <pcl6d/simulation/simulator.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

/** \file Furnished flats (scene rooms) with models at random free places, scanned: what
 * finding objects is measured on. */
namespace pcl6d::test {

/** \brief A model that stands in a room. */
struct RoomObject {
  std::size_t model = 0; ///< place in the list of models
  Eigen::Isometry3d T_scan_object = Eigen::Isometry3d::Identity();
  std::size_t samples = 0; ///< on it
  double visible = 0;      ///< share of the samples that it would have alone
};

/** \brief A scan of a room with objects. */
struct ObjectRoom {
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  Points points; ///< [m] scanner at the origin, z up
  std::vector<float> reflectance;
  std::vector<RoomObject> objects; ///< at most one of each model
};

struct ObjectRoomOptions {
  int scans = 5;             ///< of each flat
  double noise = 0.01;       ///< [m] of ranges
  double min_distance = 1.5; ///< [m] of the objects in plan
  double max_distance = 5;   ///< [m]
  std::string scanner = "rotating";
};

namespace room_objects {
constexpr std::uint32_t kFirst = 90000; // object id of the first model
constexpr int kTries = 100;             // to find a place

/** \return T_scene_object, if the place is free and on the floor */
inline std::optional<Eigen::Isometry3d>
freePlace(const RayCaster& scene,
          const Eigen::Isometry3d& T_scene_scan,
          const Eigen::AlignedBox3d& box,
          const ObjectRoomOptions& options,
          Random& random)
{
  const SinCos way = portableSinCos(random.uniform(-M_PI, M_PI));
  const SinCos turn = portableSinCos(random.uniform(-M_PI, M_PI));
  const double distance = random.uniform(options.min_distance, options.max_distance);
  Eigen::Vector3d place = T_scene_scan.translation();
  place.head<2>() += distance * Eigen::Vector2d(way.cos, way.sin);
  const auto floor = scene.cast({place, -Eigen::Vector3d::UnitZ()}, 3);
  if (!floor || floor->range < 0.3) // on a piece of furniture
    return {};
  place.z() -= floor->range;
  const double radius = box.sizes().head<2>().norm() / 2 + 0.05;
  for (double height = 0.1; height < box.sizes().z(); height += 0.1)
    for (int i = 0; i < 16; ++i) {
      const SinCos side = portableSinCos(i * M_PI / 8);
      const Eigen::Vector3d start = place + height * Eigen::Vector3d::UnitZ();
      if (scene.cast({start, {side.cos, side.sin, 0}}, radius))
        return {};
    }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear().topLeftCorner<2, 2>() << turn.cos, -turn.sin, turn.sin, turn.cos;
  const Eigen::Vector3d foot(box.center().x(), box.center().y(), box.min().z());
  pose.translation() = place - pose.linear() * foot;
  return pose;
}

/** \return samples on an object */
inline std::size_t
countSamples(const RangeScan& scan, const TriangleScene& scene, std::uint32_t object)
{
  std::size_t count = 0;
  for (const auto& sample : scan.samples)
    count += std::isfinite(sample.range) &&
                     scene.surfaces[scene.triangles[sample.triangle].surface].object ==
                         object
                 ? 1
                 : 0;
  return count;
}

/** \return how many samples an object would have without anything around it */
inline std::size_t
samplesAlone(const TriangleMesh& mesh,
             const Eigen::Isometry3d& pose,
             const ScannerPreset& scanner,
             const Eigen::Isometry3d& T_scene_scan)
{
  Surface material;
  material.object = kFirst;
  TriangleScene alone;
  addMesh(alone, mesh, pose, material);
  return countSamples(
      castScan(RayCaster(alone), *scanner.scanner, T_scene_scan, scanner.range),
      alone,
      kFirst);
}

inline ObjectRoom
scanRoom(const std::vector<StoredModel>& models,
         const TriangleScene& flat,
         const ScannerPreset& scanner,
         const Eigen::Isometry3d& T_scene_scan,
         const ObjectRoomOptions& options,
         Random& random)
{
  constexpr std::size_t kFewest = 25; // samples alone; less says nothing
  ObjectRoom room;
  TriangleScene scene = flat;
  for (std::size_t m = 0; m < models.size(); ++m) {
    const RayCaster caster(scene);
    const Eigen::AlignedBox3d& box = models[m].model.box();
    std::optional<Eigen::Isometry3d> pose;
    for (int i = 0; i < kTries && !pose; ++i)
      pose = freePlace(caster, T_scene_scan, box, options, random);
    Surface material;
    material.object = kFirst + static_cast<std::uint32_t>(m);
    material.reflectance = random.uniform(0.3, 0.8);
    if (!pose)
      continue;
    addMesh(scene, models[m].mesh, *pose, material);
    room.objects.push_back({m, T_scene_scan.inverse() * *pose, 0, 0});
  }
  RangeOptions range = scanner.range;
  range.noise = options.noise;
  range.seed = static_cast<std::uint64_t>(random.uniform() * 1e9);
  const RangeScan scan =
      castScan(RayCaster(scene), *scanner.scanner, T_scene_scan, range);
  for (const auto& p : toPointCloud(scan, *scanner.scanner))
    if (std::isfinite(p.x)) {
      room.points.push_back(p.getVector3fMap());
      room.reflectance.push_back(p.intensity);
    }
  for (auto& object : room.objects) {
    const auto id = kFirst + static_cast<std::uint32_t>(object.model);
    object.samples = countSamples(scan, scene, id);
    const std::size_t alone = samplesAlone(models[object.model].mesh,
                                           T_scene_scan * object.T_scan_object,
                                           scanner,
                                           T_scene_scan);
    if (alone >= kFewest)
      object.visible = static_cast<double>(object.samples) / static_cast<double>(alone);
  }
  return room;
}
} // namespace room_objects

/** \return scans of the flat with this seed, from which its own furniture of the models'
 * classes was taken; each scan has other objects. Same seed, same bits. */
inline std::vector<ObjectRoom>
objectRooms(const std::vector<StoredModel>& models,
            std::uint64_t seed,
            const ObjectRoomOptions& options = {})
{
  std::vector<std::string> classes;
  for (const auto& stored : models)
    classes.push_back(stored.model.objectClass());
  const ScannerPreset scanner = scannerByName(options.scanner);
  SimulationOptions simulation;
  simulation.num_scans = options.scans;
  simulation.scanner = scanner.scanner;
  simulation.seed = seed;
  const Simulator simulator(withoutObjects(builtInScene("rooms", seed), classes),
                            simulation);
  Random random(mixBits(seed));
  std::vector<ObjectRoom> rooms;
  for (const auto& T_world_scan : simulator.truth().poses) {
    rooms.push_back(room_objects::scanRoom(models,
                                           simulator.caster().scene(),
                                           scanner,
                                           simulator.sceneFromWorld() * T_world_scan,
                                           options,
                                           random));
    rooms.back().T_world_scan = T_world_scan;
  }
  return rooms;
}

} // namespace pcl6d::test
