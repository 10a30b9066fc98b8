// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/map/map_source.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/slam6d/auto_parameters.h>
#include <pcl6d/slam6d/scan_preparation.h>

#include <filesystem>
#include <functional>
#include <memory>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

/** Files and poses of a map, before reading points. */
struct MapFiles {
  std::vector<fs::path> files;
  LoadedMap map;                    ///< without points
  Eigen::Vector3d world_offset;     ///< [m] origin of the poses
  std::optional<MovedPoints> moved; ///< transformation of the points after reading
  std::function<Points(std::size_t)> read =
      {}; ///< reads a scan in the frame of its pose
};

/** Makes poses relative, to preserve the digits of float points in the world. */
void
takeOffset(MapFiles& files)
{
  files.world_offset = worldOffset(files.map.poses.front());
  for (Eigen::Isometry3d& pose : files.map.poses)
    pose.translation() -= files.world_offset;
}

MapFiles
filesOfRun(const fs::path& path)
{
  const auto opened = std::make_shared<RunFolder>(RunFolder::finished(
      path, "the run was interrupted and has no map; start the run again"));
  const RunFolder& run = *opened;
  const fs::path summary = path / "summary.json";
  MapFiles result;
  result.map.pose_source = summary.string();
  result.map.poses = run.trajectory().poses;
  result.world_offset = run.summary().world_offset;
  for (std::size_t i = 0; i < run.summary().scans.size(); ++i) {
    run.requireScan(i);
    result.files.push_back(run.scanFile(i));
    result.map.names.push_back(run.summary().scans[i].file);
  }
  result.moved = run.summary().moved;
  result.read = [opened](std::size_t i) { return opened->readScan(i); };
  return result;
}

MapFiles
filesOfScans(const fs::path& path, bool needs_poses)
{
  const auto opened = std::make_shared<ScanFolder>(path);
  const ScanFolder& folder = *opened;
  if (needs_poses && !folder.hasPoses())
    throw IoFailed(path.string() +
                   ": holds neither a run (no summary.json) nor scans with poses; give "
                   "the run's folder, or --poses FILE");
  MapFiles result;
  result.map.pose_source = folder.poseSource();
  for (std::size_t i = 0; i < folder.size(); ++i) {
    result.files.push_back(folder.file(i));
    result.map.names.push_back(folder.name(i));
    result.map.poses.push_back(folder.initialPose(i));
  }
  takeOffset(result);
  result.moved = folder.moved();
  result.read = [opened](std::size_t i) { return opened->read(i).points; };
  return result;
}

void
replacePoses(MapFiles& files, const std::string& poses)
{
  files.map.poses = readTrajectory(poses).poses;
  files.map.pose_source = poses;
  if (files.map.poses.size() != files.files.size())
    throw IoFailed(poses + ": " + std::to_string(files.map.poses.size()) +
                   " poses, but must be a pose for each of the " +
                   std::to_string(files.files.size()) + " scans");
  if (files.moved)
    for (Eigen::Isometry3d& pose : files.map.poses)
      pose = files.moved->ofNear(pose);
  takeOffset(files);
}

/** Reads a cloud in the world; a PCD file may have a pose. Full coordinates become
 * relative, like the poses. */
Points
readReference(const std::string& file, const Eigen::Vector3d& world_offset)
{
  const NearScan cloud = readNearScan(file);
  if (cloud.points.size() < 3)
    throw IoFailed(file + ": " + std::to_string(cloud.points.size()) +
                   " points, but must be at least 3");
  Eigen::Isometry3d pose = findScanPose(file).value_or(Eigen::Isometry3d::Identity()) *
                           Eigen::Translation3d(cloud.offset);
  if (!worldOffset(pose).isZero(0))
    pose.translation() -= world_offset;
  return transformed(cloud.points, pose);
}

Slam6DOptions
optionsOf(const MapSource& source)
{
  Slam6DOptions options;
  options.min_range = source.min_range;
  options.max_range = source.max_range;
  options.voxel = source.voxel;
  options.planar_rows = 0; // points as measured
  return options;
}
} // namespace

void
validateSource(const MapSource& source)
{
  optionsOf(source).validate();
}

LoadedMap
loadMap(const MapSource& source, unsigned int num_threads)
{
  const bool is_run = fs::exists(fs::path(source.folder) / "summary.json");
  MapFiles files = is_run ? filesOfRun(source.folder)
                          : filesOfScans(source.folder, source.poses.empty());
  if (!source.poses.empty())
    replacePoses(files, source.poses);
  if (files.files.size() < 2)
    throw IoFailed(source.folder +
                   ": holds one scan, but the agreement of a map needs two");
  LoadedMap map = std::move(files.map);
  map.scans.resize(files.files.size());
  parallelFor(files.files.size(), num_threads, [&](std::size_t i) {
    map.scans[i] = files.read(i);
  });
  const Slam6DParameters parameters = deriveParameters(optionsOf(source), map.scans);
  map.voxel = parameters.voxel.value;
  for (std::size_t i = 0; i < map.scans.size(); ++i)
    map.scans[i] = gateScan(map.scans[i], files.files[i].string(), parameters);
  if (!source.reference.empty())
    map.reference = readReference(source.reference, files.world_offset);
  return map;
}

} // namespace pcl6d::app
