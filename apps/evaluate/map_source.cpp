// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/map_source.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/slam6d/auto_parameters.h>
#include <pcl6d/slam6d/scan_preparation.h>

#include <filesystem>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

/** Files and poses of a map, before anything is read. */
struct MapFiles {
  std::vector<fs::path> files;
  LoadedMap map; ///< without points
};

MapFiles
filesOfRun(const fs::path& path)
{
  const RunFolder run = RunFolder::finished(
      path, "the run was interrupted, so it has no map; run it again");
  const fs::path summary = path / "summary.json";
  MapFiles result;
  result.map.pose_source = summary.string();
  result.map.poses = run.trajectory().poses;
  for (std::size_t i = 0; i < run.summary().scans.size(); ++i) {
    result.files.push_back(run.scanFile(i));
    if (!fs::exists(result.files.back()))
      throw IoFailed(result.files.back().string() + ": is missing, though " +
                     summary.string() + " tells of it");
    result.map.names.push_back(run.summary().scans[i].file);
  }
  return result;
}

MapFiles
filesOfScans(const fs::path& path, bool needs_poses)
{
  const ScanFolder folder(path);
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
  return result;
}

void
replacePoses(MapFiles& files, const std::string& poses)
{
  files.map.poses = readTrajectory(poses).poses;
  files.map.pose_source = poses;
  if (files.map.poses.size() != files.files.size())
    throw IoFailed(poses + ": " + std::to_string(files.map.poses.size()) +
                   " poses, but must be one for each of the " +
                   std::to_string(files.files.size()) + " scans");
}

/** A cloud in the world: a PCD may have a pose of its own. */
Points
readReference(const std::string& file)
{
  const Scan cloud = readScan(file);
  if (cloud.points.size() < 3)
    throw IoFailed(file + ": " + std::to_string(cloud.points.size()) +
                   " points, but must be at least 3");
  const auto pose = findScanPose(file);
  return pose ? transformed(cloud.points, *pose) : cloud.points;
}

Slam6DOptions
optionsOf(const MapSource& source)
{
  Slam6DOptions options;
  options.min_range = source.min_range;
  options.max_range = source.max_range;
  options.voxel = source.voxel;
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
    throw IoFailed(source.folder + ": holds one scan, but a map needs two to agree");
  LoadedMap map = std::move(files.map);
  map.scans.resize(files.files.size());
  parallelFor(files.files.size(), num_threads, [&](std::size_t i) {
    map.scans[i] = readScan(files.files[i]).points;
  });
  const Slam6DParameters parameters = deriveParameters(optionsOf(source), map.scans);
  map.voxel = parameters.voxel.value;
  for (std::size_t i = 0; i < map.scans.size(); ++i)
    map.scans[i] = gateScan(map.scans[i], files.files[i].string(), parameters);
  if (!source.reference.empty())
    map.reference = readReference(source.reference);
  return map;
}

} // namespace pcl6d::app
