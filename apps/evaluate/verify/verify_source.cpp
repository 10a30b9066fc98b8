// SPDX-License-Identifier: BSD-3-Clause
#include "common/open_scans.h"
#include "evaluate/pair_pose.h"
#include "evaluate/verify/verify_source.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_formats.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <utility>

namespace pcl6d::app {

namespace {
namespace fs = std::filesystem;

/** Scans before their points are read. */
struct Listing {
  std::vector<fs::path> files;
  std::vector<std::string> names;
  std::vector<std::size_t> indices;
  std::vector<Eigen::Isometry3d> poses; ///< in full coordinates
  Eigen::Vector3d world_offset = Eigen::Vector3d::Zero();
  std::string pose_source;
  std::vector<bool> unsure, unregistered; ///< as in VerifySource
  ScanParameterOptions parameters;
  std::function<Points(std::size_t)> read; ///< reads a scan in the frame of its pose
};

Points
enough(Scan scan, const fs::path& file)
{
  if (scan.points.size() < 3)
    throw IoFailed(file.string() + ": " + text::counted(scan.points.size(), "point") +
                   " with finite coordinates, but at least 3 are needed");
  return std::move(scan.points);
}

/** \return whether a folder contains a result of 3DTK, even beside the initial poses */
bool
holdsFrames(const fs::path& path)
{
  if (!fs::is_directory(path))
    return false;
  const fs::directory_iterator files(path);
  return std::any_of(begin(files), end(files), [](const fs::directory_entry& entry) {
    return entry.path().extension() == ".frames";
  });
}

/** Replaces the poses of the folder by a trajectory. */
void
replacePoses(const std::string& file, const RegisteredScans& scans, Listing& listing)
{
  const ScanFolder& folder = scans.folder();
  const TrajectoryFiles given = readTrajectoryFiles(
      file, holdsFrames(file) ? TrajectoryFormat::kFrames : TrajectoryFormat::kAuto);
  const auto& poses = given.trajectory.poses;
  const std::size_t all = folder.odometry().poses.size();
  const bool of_selected = poses.size() == folder.size();
  if (given.names.empty() && !of_selected && poses.size() != all)
    throw IoFailed(file + ": " + text::counted(poses.size(), "pose") +
                   ", but must be a pose for each of the " +
                   text::counted(all, "scan"));
  for (std::size_t i = 0; i < folder.size(); ++i) {
    std::size_t place = of_selected ? i : static_cast<std::size_t>(folder.index(i));
    if (!given.names.empty()) {
      const std::string name = folder.file(i).stem().string();
      const auto found = std::find(given.names.begin(), given.names.end(), name);
      if (found == given.names.end())
        throw IoFailed(file + ": holds no pose of " + name);
      place = static_cast<std::size_t>(found - given.names.begin());
    }
    listing.poses[i] =
        scans.moved() ? scans.moved()->ofNear(poses[place]) : poses[place];
  }
  listing.pose_source = file;
  listing.world_offset = worldOffset(listing.poses.front());
}

/** \return an option of a run, unless another value is given */
std::optional<double>
lengthOf(const RunResult& run,
         const std::string& name,
         const std::optional<double>& given)
{
  double value = 0;
  for (const auto& option : run.options)
    if (!given && option.name == name && text::parseNumber(option.value, value))
      return value;
  return given;
}

/** Takes over what a run tells of its scans. */
void
takeFrom(const RunResult& run, Listing& listing)
{
  const std::size_t count = listing.indices.size();
  listing.unsure.resize(count);
  listing.unregistered.resize(count);
  for (const ScanResult& scan : run.scans)
    for (std::size_t i = 0; i < count; ++i)
      if (static_cast<std::size_t>(scan.index) == listing.indices[i]) {
        listing.unsure[i] = isWithoutPrior(scan.start);
        listing.unregistered[i] = scan.state == ScanState::kPredicted ||
                                  scan.recovered == RecoveredBy::kBeside;
      }
}

Listing
listFolder(const VerifySettings& s, ProgressBar& bar)
{
  const std::string& path = s.inputs.front();
  const auto opened = std::make_shared<RegisteredScans>(openScans(path, s.scans));
  const RegisteredScans& scans = *opened;
  const ScanFolder& folder = scans.folder();
  if (!folder.coordinates().empty())
    bar.warn(folder.coordinates());
  if (s.poses.empty() && !scans.summary() && !folder.hasPoses() && folder.size() > 1)
    throw IoFailed(path +
                   ": holds neither a run (no summary.json) nor scans with poses; "
                   "give --poses FILE");
  Listing listing;
  for (std::size_t i = 0; i < folder.size(); ++i) {
    listing.files.push_back(folder.file(i));
    listing.names.push_back(folder.name(i));
    listing.indices.push_back(scans.index(i));
    listing.poses.push_back(scans.pose(i));
  }
  listing.pose_source = scans.poseSource();
  listing.world_offset = scans.worldOffset();
  listing.parameters = s.parameters;
  if (scans.summary())
    listing.parameters = {
        lengthOf(*scans.summary(), "min-range", s.parameters.min_range),
        lengthOf(*scans.summary(), "max-range", s.parameters.max_range),
        lengthOf(*scans.summary(), "voxel", s.parameters.voxel),
        s.parameters.line_spacing};
  if (scans.summary() && s.poses.empty())
    takeFrom(*scans.summary(), listing);
  if (!s.poses.empty())
    replacePoses(s.poses, scans, listing);
  listing.read = [opened](std::size_t i) {
    return enough(opened->folder().read(i), opened->folder().file(i));
  };
  return listing;
}

/** The scans of a pair, brought near; the world is A's frame. */
void
readPair(const Eigen::Isometry3d& T_a_b,
         const VerifySettings& s,
         Listing& listing,
         ProgressBar& bar)
{
  const auto pair = std::make_shared<std::array<NearScan, 2>>();
  for (std::size_t i = 0; i < 2; ++i) {
    (*pair)[i] = readNearScan(listing.files[i], s.scans.format);
    if (!(*pair)[i].description.empty())
      bar.warn(listing.names[i] + ": " + (*pair)[i].description);
  }
  listing.world_offset = (*pair)[0].offset;
  for (std::size_t i = 0; i < 2; ++i)
    listing.poses.push_back((i == 0 ? Eigen::Isometry3d::Identity() : T_a_b) *
                            Eigen::Translation3d((*pair)[i].offset));
  listing.read = [pair, files = listing.files](std::size_t i) {
    return enough(std::move((*pair)[i]), files[i]);
  };
}

Listing
listPair(const VerifySettings& s, ProgressBar& bar)
{
  const std::string &a = s.inputs[0], &b = s.inputs[1];
  for (const std::string& file : s.inputs)
    if (!fs::is_regular_file(file))
      throw IoFailed(file + (fs::exists(file) ? ": is no file: of two inputs, both are "
                                                "scans"
                                              : ": no such file"));
  PairPose pose;
  pose.source = "--pose";
  if (s.pose.empty())
    pose = poseOfPair(a, b, s.scans.format, "--pose");
  else if (fs::is_regular_file(s.pose))
    pose = {poseFromFile(s.pose), s.pose, true};
  else
    pose.T_a_b = poseFromText("--pose", s.pose);
  if (!pose.found)
    throw IoFailed("no poses belong to " + a + " and " + b + "; give --pose");
  Listing listing;
  listing.files = {a, b};
  listing.names = {fs::path(a).filename().string(), fs::path(b).filename().string()};
  if (listing.names[0] == listing.names[1])
    listing.names = {a, b};
  listing.indices = {0, 1};
  listing.pose_source = pose.source;
  listing.parameters = s.parameters;
  readPair(pose.T_a_b, s, listing, bar);
  return listing;
}
} // namespace

std::optional<VerifySource>
loadVerifySource(const VerifySettings& s, ProgressBar& bar, const Interrupt& interrupt)
{
  Listing listing = s.isPair() ? listPair(s, bar) : listFolder(s, bar);
  const std::size_t count = listing.files.size();
  bar.say(text::counted(count, "scan") + ", poses from " + listing.pose_source);
  constexpr std::size_t kScansForParameters = 16; // as of a run
  std::vector<Points> points(std::min(count, kScansForParameters));
  parallelFor(points.size(), s.num_threads, [&](std::size_t i) {
    points[i] = listing.read(i);
  });
  PreparedScans prepared(
      count, deriveScanParameters(listing.parameters, points), s.num_threads);
  const ScanParameters& p = prepared.parameters();
  bar.say(parameterLine("min-range", p.min_range));
  bar.say(parameterLine("max-range", p.max_range));
  bar.say(parameterLine("voxel", p.voxel));
  // small enough to show progress and to be interrupted
  constexpr std::size_t kBatch = 8;
  for (std::size_t begin = 0; begin < count; begin += kBatch) {
    if (interrupt.requested())
      return {};
    const std::size_t end = std::min(begin + kBatch, count);
    parallelFor(end - begin, s.num_threads, [&](std::size_t k) {
      const std::size_t i = begin + k;
      prepared.set(i,
                   i < points.size() ? std::exchange(points[i], {}) : listing.read(i),
                   listing.files[i].string());
    });
    bar.show({"reading", end, count});
  }
  for (Eigen::Isometry3d& pose : listing.poses)
    pose.translation() -= listing.world_offset;
  return VerifySource{listing.names,
                      listing.indices,
                      listing.poses,
                      listing.world_offset,
                      listing.pose_source,
                      listing.unsure,
                      listing.unregistered,
                      std::move(prepared)};
}

} // namespace pcl6d::app
