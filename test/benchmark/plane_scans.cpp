// SPDX-License-Identifier: BSD-3-Clause
#include "plane_scans.h"
#include "support/data_folder.h"

#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/simulation/scene_truth.h>
#include <pcl6d/simulation/simulator.h>

#include <cmath>

namespace pcl6d::benchmarks {

namespace {
PlaneScan
firstScan(std::uint64_t seed)
{
  const auto scene = builtInScene("rooms", seed);
  SimulationOptions options;
  options.num_scans = scene.num_scans;
  options.seed = seed;
  options.range.max_range = scene.max_range;
  const Simulator simulator(scene, options);
  const RangeScan scan = simulator.rangeScan(0);
  const TriangleScene& geometry = simulator.caster().scene();
  PlaneScan result;
  result.points = toPoints(toPointCloud(scan, simulator.scanner()));
  result.planes = scenePlanes(
      geometry, simulator.sceneFromWorld() * simulator.truth().poses.front());
  for (const auto& sample : scan.samples)
    result.truth.push_back(
        std::isfinite(sample.range)
            ? geometry.surfaces[geometry.triangles[sample.triangle].surface].plane
            : 0);
  return result;
}
} // namespace

std::vector<PlaneScan>
simulatedRooms()
{
  std::vector<PlaneScan> scans;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    scans.push_back(firstScan(seed));
  return scans;
}

std::shared_ptr<const Points>
kurt3dScan()
{
  const auto folder = test::dataFolder("kurt3d");
  if (folder.empty())
    return nullptr;
  return std::make_shared<const Points>(
      gateByRange(ScanFolder(folder).read(1).points, 0.2, 32));
}

} // namespace pcl6d::benchmarks
