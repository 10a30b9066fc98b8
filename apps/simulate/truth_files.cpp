// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/truth_files.h"

#include <pcl6d/io/object_io.h>
#include <pcl6d/io/plane_io.h>
#include <pcl6d/simulation/scene_truth.h>

namespace pcl6d::app {
namespace {
std::size_t
countOf(const std::vector<std::size_t>& counts, std::size_t id)
{
  return id < counts.size() ? counts[id] : 0;
}
} // namespace

void
writeTruthFiles(const OutputFolder& folder,
                const SimulationScene& scene,
                const Simulator& simulator,
                const TruthCounts& counts)
{
  std::vector<Plane> planes = scenePlanes(scene.geometry, simulator.sceneFromWorld());
  for (std::size_t i = 0; i < planes.size(); ++i)
    planes[i].inliers = countOf(counts.planes, i + 1);
  writePlanes(folder / "planes_truth.json", planes);
  std::vector<ObjectPose> objects = sceneObjects(scene, simulator.sceneFromWorld());
  for (std::size_t i = 0; i < objects.size(); ++i)
    objects[i].points = countOf(counts.objects, i + 1);
  writeObjects(folder / "objects_truth.json", objects);
}

} // namespace pcl6d::app
