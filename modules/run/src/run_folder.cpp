// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/number_range.h>
#include <pcl6d/common/option_names.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/frames_io.h>
#include <pcl6d/io/object_io.h>
#include <pcl6d/io/plane_io.h>
#include <pcl6d/io/pose_graph_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/run/run_links_io.h>
#include <pcl6d/run/run_summary.h>
#include <pcl6d/run/written_files.h>

namespace pcl6d {

namespace {
namespace fs = std::filesystem;

constexpr const char* kSummary = "summary.json";
constexpr const char* kTrajectory = "trajectory.kitti";
constexpr const char* kMap = "map.pcd";
constexpr const char* kMoving = "moving.pcd";

/** \return the values of a field; empty if the field is missing */
template <typename T>
std::vector<T>
valuesOf(const pcl::PCLPointCloud2& cloud, const std::string& name)
{
  const auto field = fieldValues(cloud, name);
  if (!field)
    return {};
  std::vector<T> values;
  values.reserve(field->values.size());
  for (const double value : field->values)
    if constexpr (std::is_integral_v<T>)
      values.push_back(clampedTo<T>(value));
    else
      values.push_back(static_cast<T>(value));
  return values;
}

std::string
valueOf(const RunResult& summary, const std::string& option)
{
  for (const auto& candidate : summary.options)
    if (candidate.name == option)
      return candidate.value;
  return {};
}
} // namespace

RunFolder::RunFolder(const fs::path& path) : path_(path)
{
  std::error_code error;
  if (!fs::is_directory(path, error))
    text::fail(path, "no such folder");
  has_summary_ = has(kSummary);
  if (has_summary_) {
    summary_ = readRunSummary(path / kSummary);
    return;
  }
  if (!has(kTrajectory) && !has(kMap))
    text::fail(path,
               "holds no run of pcl_slam6d (neither summary.json, trajectory.kitti nor "
               "map.pcd)");
  summary_.complete = summary_.trusted = false;
  summary_.verdict = "not known: summary.json is missing";
  if (has(kTrajectory))
    takeScansFromPoses();
}

RunFolder::RunFolder(const fs::path& path, RunResult result)
: path_(path), has_summary_(true), summary_(std::move(result))
{}

RunFolder
RunFolder::finished(const fs::path& path, const std::string& unfinished)
{
  requireRun(path);
  const RunFolder run(path, readRunSummary(path / kSummary));
  run.requireSizes();
  if (!run.summary().complete)
    text::fail(path / kSummary, unfinished);
  return run;
}

void
RunFolder::requireSizes() const
{
  for (const auto& [name, written] : summary_.files)
    requireAsWritten(path_ / name, written, false);
}

void
RunFolder::requireWhole(const std::string& start) const
{
  for (const auto& [name, written] : summary_.files)
    if (name.rfind(start, 0) == 0)
      requireAsWritten(path_ / name, written, true);
}

/** \return the file \throws IoFailed the file differs from the run's output */
fs::path
RunFolder::asWritten(const fs::path& file) const
{
  const auto known = summary_.files.find(file.lexically_relative(path_).string());
  if (known != summary_.files.end())
    requireAsWritten(file, known->second, true);
  return file;
}

void
RunFolder::takeScansFromPoses()
{
  const Trajectory trajectory = readTrajectory(path_ / kTrajectory);
  if (!trajectory.poses.empty())
    summary_.world_offset = worldOffset(trajectory.poses.front());
  for (std::size_t i = 0; i < trajectory.poses.size(); ++i) {
    ScanResult& scan = summary_.scans.emplace_back();
    scan.index = static_cast<int>(i);
    scan.file = scanName(scan.index);
    scan.state = ScanState::kUnknown;
    scan.initial_pose = scan.T_world_scan = trajectory.poses[i];
    if (!text::isThere(framesFile(i)))
      continue;
    const auto frames = readFrames(framesFile(i));
    if (!frames.empty())
      scan.initial_pose = frames.front().T_world_scan;
  }
}

bool
RunFolder::has(const std::string& name) const
{
  return text::isThere(path_ / name);
}

std::vector<std::string>
RunFolder::missing() const
{
  const bool interrupted = has_summary_ && !summary_.complete;
  const bool no_graph = interrupted || summary_.scans.size() == 1 ||
                        (valueOf(summary_, kLoopClosingOption) == "none" &&
                         valueOf(summary_, kRelaxationOption) == "none");
  std::vector<std::string> missing;
  for (const std::string name : {kSummary, kTrajectory, "frames", "scans", kMap}) {
    const bool left_out = interrupted && (name == "scans" || name == kMap);
    if (!has(name))
      missing.push_back(name + (left_out ? " (the run was interrupted)" : ""));
  }
  for (const std::string name : {"graph.g2o", "links.csv"})
    if (!has(name) && !no_graph)
      missing.push_back(name);
  if (!interrupted && summary_.moving && summary_.moving->total() > 0 && !has(kMoving))
    missing.push_back(kMoving);
  for (std::size_t i = 0; i < summary_.scans.size(); ++i) {
    if (has("scans") && !text::isThere(scanPath(i)))
      missing.push_back("scans/" + scanPath(i).filename().string());
    if (has("frames") && !text::isThere(framesFile(i)))
      missing.push_back("frames/" + framesFile(i).filename().string());
  }
  return missing;
}

fs::path
RunFolder::scanPath(std::size_t place) const
{
  return path_ / "scans" / (scanName(summary_.scans.at(place).index) + ".pcd");
}

fs::path
RunFolder::scanFile(std::size_t place) const
{
  return asWritten(scanPath(place));
}

void
RunFolder::requireScan(std::size_t place) const
{
  const fs::path file = scanPath(place);
  if (!text::isThere(file))
    text::fail(file,
               "is missing, though " + (path_ / "summary.json").string() +
                   " lists the file");
}

fs::path
RunFolder::mapFile() const
{
  return asWritten(path_ / kMap);
}

fs::path
RunFolder::framesFile(std::size_t place) const
{
  return path_ / "frames" / (scanName(summary_.scans.at(place).index) + ".frames");
}

Eigen::Isometry3d
RunFolder::relative(Eigen::Isometry3d pose) const
{
  pose.translation() -= summary_.world_offset;
  return pose;
}

Trajectory
RunFolder::trajectory() const
{
  Trajectory trajectory;
  for (const auto& scan : summary_.scans)
    trajectory.poses.push_back(relative(scan.T_world_scan));
  return trajectory;
}

Trajectory
RunFolder::initialTrajectory() const
{
  Trajectory trajectory;
  for (std::size_t i = 0; i < summary_.scans.size(); ++i)
    trajectory.poses.push_back(relative(initialPoseOf(summary_, i)));
  return trajectory;
}

std::vector<std::vector<Frame>>
RunFolder::readHistory() const
{
  std::vector<std::vector<Frame>> history(summary_.scans.size());
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (!text::isThere(framesFile(i)))
      continue;
    history[i] = readFrames(asWritten(framesFile(i)));
    for (Frame& frame : history[i])
      frame.T_world_scan = relative(frame.T_world_scan);
  }
  return history;
}

RunMap
RunFolder::readMap() const
{
  return readMapOf(kMap);
}

RunMap
RunFolder::readMoving() const
{
  return readMapOf(kMoving);
}

RunMap
RunFolder::readMapOf(const char* name) const
{
  RunMap map;
  if (!has(name))
    return map;
  Scan scan = pcl6d::readScan(asWritten(path_ / name));
  map.points = std::move(scan.points);
  map.scans = valuesOf<std::uint32_t>(scan.cloud, "scan");
  map.intensities = valuesOf<float>(scan.cloud, "intensity");
  return map;
}

Scan
RunFolder::readStandingScan(std::size_t place) const
{
  const fs::path file = scanFile(place);
  if (!text::isThere(file))
    return {};
  Scan scan = pcl6d::readScan(file);
  if (!summary_.moving || summary_.moving->removed)
    return scan; // the field "dynamic" is from another source
  const auto moved = fieldValues(scan.cloud, "dynamic");
  if (!moved)
    return scan;
  std::vector<bool> stands;
  for (const double value : moved->values)
    stands.push_back(value == 0);
  keepPoints(scan.cloud, stands);
  scan.points = coordinatesOf(scan.cloud);
  return scan;
}

RunMap
RunFolder::readScanCloud(std::size_t place) const
{
  RunMap map;
  Scan scan = readStandingScan(place);
  if (scan.points.empty())
    return map;
  map.points = std::move(scan.points);
  map.scans.assign(map.points.size(),
                   static_cast<std::uint32_t>(summary_.scans[place].index));
  map.intensities = valuesOf<float>(scan.cloud, "intensity");
  return map;
}

Points
RunFolder::readScan(std::size_t place) const
{
  return readStandingScan(place).points;
}

std::vector<RunLink>
RunFolder::readLinks(const std::function<std::string(const RunLink&)>& fault) const
{
  return has("links.csv") ? readRunLinks(asWritten(path_ / "links.csv"), fault)
                          : std::vector<RunLink>();
}

PoseGraph
RunFolder::readGraph() const
{
  return has("graph.g2o") ? readPoseGraph(asWritten(path_ / "graph.g2o")) : PoseGraph();
}

std::vector<Plane>
RunFolder::readPlanes() const
{
  return has("planes.json") ? pcl6d::readPlanes(asWritten(path_ / "planes.json"))
                            : std::vector<Plane>();
}

RunPlanePoints
RunFolder::readPlanePoints() const
{
  RunPlanePoints result;
  const fs::path file = asWritten(path_ / "planes.pcd");
  if (!has("planes.pcd"))
    return result;
  Scan scan = pcl6d::readScan(file);
  result.points = std::move(scan.points);
  result.plane_of = valuesOf<std::uint32_t>(scan.cloud, "plane_id");
  if (result.plane_of.size() != result.points.size())
    text::fail(file, "has no field plane_id");
  return result;
}

std::vector<ObjectPose>
RunFolder::readObjects() const
{
  return has("objects.json") ? pcl6d::readObjects(path_ / "objects.json")
                             : std::vector<ObjectPose>();
}

} // namespace pcl6d
