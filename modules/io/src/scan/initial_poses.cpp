// SPDX-License-Identifier: BSD-3-Clause
#include "scan/initial_poses.h"
#include "scan/stamps_of_scans.h"
#include "trajectory/camera_poses.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/ptx_io.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>

#include <algorithm>
#include <cctype>

namespace pcl6d {

using namespace io;

namespace fs = std::filesystem;

namespace {

using Paths = std::vector<fs::path>;

/** \return a trajectory with a pose for each scan \param[in] holder "the folder" */
Trajectory
readPoses(const fs::path& file,
          const Paths& scans,
          const std::string& holder = "the folder")
{
  Trajectory trajectory = readTrajectory(file);
  const std::size_t poses = trajectory.poses.size();
  if (poses != scans.size())
    if (auto of_scans = posesAtStamps(trajectory, stampsOfNames(scans)))
      return *std::move(of_scans);
  if (poses != scans.size())
    text::fail(file,
               text::counted(poses, "pose") + ", but " + holder + " holds " +
                   text::counted(scans.size(), "scan") +
                   (poses < scans.size()
                        ? ": no pose for " + scans[poses].filename().string()
                        : ""));
  return trajectory;
}

fs::path
posePath(fs::path scan)
{
  return scan.replace_extension(".pose");
}

Trajectory
readScanPoses(const Paths& scans)
{
  Trajectory trajectory;
  for (const auto& scan : scans) {
    const fs::path file = posePath(scan);
    if (!text::isThere(file))
      text::fail(file,
                 "missing, although further scans have a .pose file: no pose for " +
                     scan.filename().string());
    trajectory.poses.push_back(readUosPose(file));
  }
  return trajectory;
}

/** \return the pose in a PCD or PTX file */
Eigen::Isometry3d
poseInFile(const fs::path& scan, ScanFormat format)
{
  return format == ScanFormat::kPcd ? readPcdViewpoint(scan)
                                    : listPtxScans(scan).front().T_world_scan;
}

Trajectory
readOwnPoses(const Paths& scans, ScanFormat format)
{
  Trajectory trajectory;
  for (const auto& scan : scans)
    trajectory.poses.push_back(poseInFile(scan, format));
  return trajectory;
}

bool
isIdentity(const Eigen::Isometry3d& pose)
{
  return pose.matrix() == Eigen::Matrix4d::Identity();
}

} // namespace

bool
io::isGroundtruth(const fs::path& path)
{
  constexpr std::string_view kStart = "groundtruth";
  const std::string name = path.filename().string().substr(0, kStart.size());
  return std::equal(
      name.begin(), name.end(), kStart.begin(), kStart.end(), [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == b;
      });
}

bool
io::isPosesFile(const fs::path& path)
{
  const std::string name = path.filename().string();
  return name == "odometry.txt" || name == "poses.txt" || name == kCalibration ||
         std::find(std::begin(kStampsFiles), std::end(kStampsFiles), name) !=
             std::end(kStampsFiles);
}

std::optional<Eigen::Isometry3d>
findScanPose(const fs::path& scan, ScanFormat format)
{
  if (text::isThere(posePath(scan)))
    return readUosPose(posePath(scan));
  if (format == ScanFormat::kAuto)
    format = scanFormatOfExtension(scan);
  if (format != ScanFormat::kPcd && format != ScanFormat::kPtx)
    return std::nullopt;
  const Eigen::Isometry3d pose = poseInFile(scan, format);
  return isIdentity(pose) ? std::nullopt : std::optional(pose);
}

namespace {
/** \return the poses of a file of rows, for each scan; KITTI's camera poses are converted to
 * lidar poses if a folder contains a calib.txt */
InitialPoses
posesOfFile(const fs::path& file, const Paths& scans, const Paths& folders)
{
  InitialPoses poses{readPoses(file, scans), file.string(), {}};
  for (const auto& folder : folders)
    if (text::isThere(folder / kCalibration) &&
        takeCameraPoses(folder / kCalibration, poses.trajectory)) {
      poses.source += " (of the camera, by " + std::string(kCalibration) + ")";
      break;
    }
  return poses;
}

/** \param[in] folders folder of the scans, then optionally the parent */
InitialPoses
findPoses(const Paths& folders,
          const Paths& scans,
          ScanFormat format,
          const fs::path& poses_file)
{
  if (!poses_file.empty())
    return posesOfFile(poses_file, scans, folders);
  if (std::any_of(scans.begin(), scans.end(), [](const fs::path& scan) {
        return text::isThere(posePath(scan));
      }))
    return {readScanPoses(scans), "scan poses (*.pose)", {}};
  for (const auto& folder : folders)
    for (const char* const name : {"odometry.txt", "poses.txt"})
      if (text::isThere(folder / name)) {
        InitialPoses poses = posesOfFile(folder / name, scans, folders);
        poses.source.replace(0, (folder / name).string().size(), name);
        return poses;
      }
  if (format == ScanFormat::kPcd || format == ScanFormat::kPtx) {
    Trajectory own = readOwnPoses(scans, format);
    if (!std::all_of(own.poses.begin(), own.poses.end(), isIdentity))
      return {std::move(own),
              format == ScanFormat::kPcd ? "PCD VIEWPOINT" : "headers of PTX",
              {}};
  }
  Trajectory identity;
  identity.poses.assign(scans.size(), Eigen::Isometry3d::Identity());
  return {std::move(identity), kNoPoses, {}};
}

/** \return if the scans are named by row numbers, from 0 on, the stamps of the rows (KITTI, with
 * scans of some rows missing); empty if names are not numbers or a row is missing */
std::optional<std::vector<double>>
stampsByNumber(const std::vector<double>& rows, const Paths& scans)
{
  std::vector<double> stamps;
  for (const fs::path& scan : scans) {
    std::size_t number = 0;
    if (!text::parseNumber(scan.stem().string(), number) || number >= rows.size() ||
        (!stamps.empty() && rows[number] <= stamps.back()))
      return std::nullopt;
    stamps.push_back(rows[number]);
  }
  return stamps;
}

/** \return a stamp for each scan */
std::vector<double>
readScanStamps(const fs::path& file, const Paths& scans)
{
  std::vector<double> stamps = readStamps(file);
  if (stamps.size() > scans.size())
    if (auto of_scans = stampsByNumber(stamps, scans))
      return *std::move(of_scans);
  if (stamps.size() != scans.size())
    text::fail(file,
               text::counted(stamps.size(), "time stamp") + ", but the folder holds " +
                   text::counted(scans.size(), "scan"));
  return stamps;
}

/** \return the file with the stamps of the scans, or empty */
fs::path
stampsFileOf(const FoundScans& scans)
{
  for (const auto& folder : scans.folders)
    for (const char* const name : kStampsFiles)
      if (text::isThere(folder / name))
        return folder / name;
  return scans.layout ? scans.layout->stamps : fs::path();
}
} // namespace

namespace {
/** \return for a folder without poses, a sentence on .pose files that belong to no scan; or empty */
std::string
noteOfUnusedPoses(const fs::path& folder)
{
  std::size_t count = 0;
  std::string first;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error)) {
    if (entry->path().extension() != ".pose")
      continue;
    const std::string name = entry->path().filename().string();
    if (++count == 1 || name < first)
      first = name;
  }
  return count == 0 ? ""
                    : text::counted(count, ".pose file") +
                          " not used: no scan has the name of " + first;
}
} // namespace

InitialPoses
io::initialPosesOf(const ScanSource& source, const fs::path& poses_file)
{
  Paths names;
  InitialPoses poses{{}, source.poseSource(), {}};
  bool has_poses = false;
  for (const auto& scan : source.scans()) {
    names.emplace_back(scan.name);
    poses.trajectory.poses.push_back(scan.pose.value_or(Eigen::Isometry3d::Identity()));
    has_poses |= !isIdentity(poses.trajectory.poses.back());
    if (scan.stamp)
      poses.trajectory.stamps.push_back(*scan.stamp);
  }
  if (!has_poses)
    poses.source = kNoPoses;
  if (poses.trajectory.stamps.size() != names.size())
    poses.trajectory.stamps.clear(); // incomplete
  if (poses_file.empty())
    return poses;
  Trajectory given = readPoses(poses_file, names, source.path().string());
  if (given.stamps.empty())
    given.stamps = std::move(poses.trajectory.stamps);
  return {std::move(given), poses_file.string(), {}};
}

InitialPoses
io::findInitialPoses(const FoundScans& scans, const fs::path& poses_file)
{
  InitialPoses poses = findPoses(scans.folders, scans.files, scans.format, poses_file);
  std::vector<double>& stamps = poses.trajectory.stamps;
  std::string source = poses.source;
  if (stamps.empty())
    if (const fs::path file = stampsFileOf(scans); !file.empty()) {
      stamps = readScanStamps(file, scans.files);
      source = file.filename().string();
    }
  poses.note = contradictionOfStamps(stamps, source, scans.files);
  if (poses.note.empty() && poses.source == kNoPoses)
    poses.note = noteOfUnusedPoses(scans.folders.front());
  if (stamps.empty())
    stamps = stampsOfNames(scans.files);
  return poses;
}

} // namespace pcl6d
