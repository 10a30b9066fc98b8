// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/random.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/simulation/scene_truth.h>
#include <pcl6d/simulation/simulator.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl6d::test {

/** \brief All scans of a simulated scene in one frame, whose z points up, with what
 * each point lies on. */
struct LabelledMap {
  Points points;                       ///< [m]
  Points viewpoints;                   ///< [m] of each point
  std::vector<std::uint32_t> plane_id; ///< of each point; 0: none
  std::vector<Plane> truth;            ///< the plane with id i at place i - 1
};

/** \brief Errors of the poses at which the scans of a map are put together. */
struct PoseNoise {
  double angle = 0;    ///< [rad] standard deviation about each axis
  double position = 0; ///< [m] along each axis
};

inline LabelledMap
makeLabelledMap(const std::string& scene_name,
                std::uint64_t seed,
                double noise,
                const PoseNoise& pose_noise = {})
{
  const auto preset = scannerByName("rotating");
  SimulationScene scene = builtInScene(scene_name, seed);
  SimulationOptions options;
  options.num_scans = scene.num_scans;
  options.seed = seed;
  options.scanner = preset.scanner;
  options.range = preset.range;
  options.range.noise = noise;
  options.range.max_range = scene.max_range;
  const Simulator simulator(scene, options);
  const TriangleScene& geometry = simulator.caster().scene();
  LabelledMap map;
  map.truth = scenePlanes(geometry);
  Random random(seed);
  const auto drawn = [&random](double sigma) {
    const double x = sigma * random.normal();
    const double y = sigma * random.normal();
    const double z = sigma * random.normal();
    return Eigen::Vector3d(x, y, z);
  };
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    Eigen::Isometry3d pose = simulator.sceneFromWorld() * simulator.truth().poses[i];
    pose.linear() = rotationFromVector(drawn(pose_noise.angle)) * pose.linear();
    pose.translation() += drawn(pose_noise.position);
    const RangeScan scan = simulator.rangeScan(i);
    const auto cloud = toPointCloud(scan, simulator.scanner());
    for (std::size_t j = 0; j < cloud.size(); ++j) {
      const Eigen::Vector3d p = cloud[j].getVector3fMap().cast<double>();
      if (!p.allFinite())
        continue;
      const Triangle& hit = geometry.triangles[scan.samples[j].triangle];
      map.points.push_back((pose * p).cast<float>());
      map.viewpoints.push_back(pose.translation().cast<float>());
      map.plane_id.push_back(geometry.surfaces[hit.surface].plane);
    }
  }
  return map;
}

} // namespace pcl6d::test
