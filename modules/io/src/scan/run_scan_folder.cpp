// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>

#include <utility>

namespace pcl6d {

namespace fs = std::filesystem;

std::vector<double>
stampsOfRun(const fs::path& run, const RunResult& summary)
{
  const fs::path file = run / "trajectory.tum";
  std::vector<double> stamps = readTrajectory(file).stamps;
  if (stamps.size() != summary.scans.size())
    text::fail(file,
               "holds " + text::counted(stamps.size(), "pose") + " for " +
                   text::counted(summary.scans.size(), "scan"));
  for (std::size_t i = 0; i < stamps.size(); ++i)
    if (stamps[i] != summary.scans[i].index)
      return stamps;
  return {};
}

ScanFolder
ScanFolder::ofRuns(const std::vector<Registered>& scans,
                   std::vector<double> stamps,
                   const std::optional<MovedPoints>& moved,
                   const std::string& source)
{
  require(!scans.empty(), "scans", scans.size(), "> 0");
  require(stamps.empty() || stamps.size() == scans.size(),
          "stamps",
          stamps.size(),
          "one per scan, or none");
  ScanFolder folder;
  for (const Registered& scan : scans) {
    Entry& entry = folder.entries_.emplace_back();
    entry.file = scan.file;
    entry.name = scan.name;
    entry.index = scan.index;
    entry.format = ScanFormat::kPcd;
    entry.given = entry.pose = scan.initial_pose;
    folder.odometry_.poses.push_back(scan.initial_pose);
  }
  folder.odometry_.stamps = stamps;
  folder.stamps_ = std::move(stamps);
  folder.pose_source_ = source;
  folder.num_registered_ = scans.size();
  folder.moved_ = moved;
  if (moved)
    folder.coordinates_ = "points that lay far from their origin are as the runs "
                          "brought them near";
  return folder;
}

} // namespace pcl6d
