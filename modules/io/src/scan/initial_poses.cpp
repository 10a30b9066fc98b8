// SPDX-License-Identifier: BSD-3-Clause
#include "scan/initial_poses.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/pcd_io.h>
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

/** \return a trajectory with one pose per scan */
Trajectory
readPoses(const fs::path& file, const Paths& scans)
{
  Trajectory trajectory = readTrajectory(file);
  const std::size_t poses = trajectory.poses.size();
  if (poses != scans.size())
    text::fail(file,
               text::counted(poses, "pose") + ", but the folder holds " +
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
                 "missing, but other scans have a .pose file: no pose for " +
                     scan.filename().string());
    trajectory.poses.push_back(readUosPose(file));
  }
  return trajectory;
}

Trajectory
readViewpoints(const Paths& scans)
{
  Trajectory trajectory;
  std::transform(scans.begin(),
                 scans.end(),
                 std::back_inserter(trajectory.poses),
                 readPcdViewpoint);
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

std::optional<Eigen::Isometry3d>
findScanPose(const fs::path& scan, ScanFormat format)
{
  if (text::isThere(posePath(scan)))
    return readUosPose(posePath(scan));
  if ((format == ScanFormat::kAuto ? scanFormatOfExtension(scan) : format) !=
      ScanFormat::kPcd)
    return std::nullopt;
  const Eigen::Isometry3d viewpoint = readPcdViewpoint(scan);
  return isIdentity(viewpoint) ? std::nullopt : std::optional(viewpoint);
}

namespace {
InitialPoses
findPoses(const fs::path& folder,
          const Paths& scans,
          ScanFormat format,
          const fs::path& poses_file)
{
  if (isGroundtruth(poses_file))
    throw BadArgument("poses_file = " + poses_file.string() +
                      ", but files named groundtruth* are never read");
  if (!poses_file.empty())
    return {readPoses(poses_file, scans), poses_file.string()};
  if (std::any_of(scans.begin(), scans.end(), [](const fs::path& scan) {
        return text::isThere(posePath(scan));
      }))
    return {readScanPoses(scans), "scan poses (*.pose)"};
  for (const char* const name : {"odometry.txt", "poses.txt"})
    if (text::isThere(folder / name))
      return {readPoses(folder / name, scans), name};
  if (format == ScanFormat::kPcd) {
    Trajectory viewpoints = readViewpoints(scans);
    if (!std::all_of(viewpoints.poses.begin(), viewpoints.poses.end(), isIdentity))
      return {std::move(viewpoints), "PCD VIEWPOINT"};
  }
  Trajectory identity;
  identity.poses.assign(scans.size(), Eigen::Isometry3d::Identity());
  return {std::move(identity), kNoPoses};
}

/** \return one stamp per scan */
std::vector<double>
readScanStamps(const fs::path& file, const Paths& scans)
{
  std::vector<double> stamps = readStamps(file);
  if (stamps.size() != scans.size())
    text::fail(file,
               text::counted(stamps.size(), "time stamp") + ", but the folder holds " +
                   text::counted(scans.size(), "scan"));
  return stamps;
}
} // namespace

InitialPoses
io::findInitialPoses(const fs::path& folder,
                     const Paths& scans,
                     ScanFormat format,
                     const fs::path& poses_file)
{
  InitialPoses poses = findPoses(folder, scans, format, poses_file);
  if (poses.trajectory.stamps.empty() && text::isThere(folder / kStampsFile))
    poses.trajectory.stamps = readScanStamps(folder / kStampsFile, scans);
  return poses;
}

} // namespace pcl6d
