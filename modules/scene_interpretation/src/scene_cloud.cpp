// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/scene_interpretation/scene_cloud.h>

#include <algorithm>
#include <cstdint>

namespace pcl6d {

namespace {
constexpr std::size_t kScansForParameters = 16;

void
report(const ProgressCallback& progress, std::size_t done, std::size_t total)
{
  if (progress)
    progress({"reading", done, total});
}
} // namespace

SceneCloud
sceneCloudOf(const MapBuilder& map,
             const std::vector<Eigen::Isometry3d>& poses,
             const Eigen::Vector3d& world_offset)
{
  SceneCloud cloud;
  cloud.points = map.points();
  cloud.world_offset = world_offset;
  for (const auto scan : map.scans())
    cloud.viewpoints.push_back(
        (poses[scan].translation() - world_offset).cast<float>());
  return cloud;
}

ScanParameters
sceneParameters(const RegisteredScans& scans,
                const ScanParameterOptions& given,
                const ProgressCallback& progress)
{
  ScanParameterOptions options = given;
  if (scans.summary()) { // take the range gate of the run
    options.min_range = given.min_range.value_or(scans.minRange());
    options.max_range = given.max_range.value_or(scans.maxRange());
  }
  options.validate();
  std::vector<Points> first;
  const std::size_t count = std::min(scans.folder().size(), kScansForParameters);
  for (std::size_t i = 0; i < count; ++i) {
    report(progress, i, count);
    first.push_back(scans.folder().read(i).points);
  }
  ScanParameters parameters = deriveScanParameters(options, first);
  if (!parameters.voxel.given) {
    parameters.voxel.value = planeVoxel(parameters.voxel.value);
    parameters.voxel.why = "a third of the voxel that matching would take";
  }
  return parameters;
}

SceneCloud
joinScans(const RegisteredScans& scans,
          const ScanParameters& parameters,
          const ProgressCallback& progress)
{
  MapBuilder map(parameters.voxel.value, scans.worldOffset());
  std::vector<Eigen::Isometry3d> poses;
  const std::size_t count = scans.folder().size();
  for (std::size_t i = 0; i < count; ++i) {
    poses.push_back(scans.pose(i));
    Points points = scans.folder().read(i).points;
    maskOutOfRange(parameters.min_range.value, parameters.max_range.value, points);
    map.addScan(points, {}, poses.back(), static_cast<std::uint32_t>(i));
    report(progress, i + 1, count);
  }
  return sceneCloudOf(map, poses, scans.worldOffset());
}

} // namespace pcl6d
