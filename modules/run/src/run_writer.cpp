// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/trajectory.h>
#include <pcl6d/io/frames_io.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/pose_graph_io.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/control_table.h>
#include <pcl6d/run/run_links_io.h>
#include <pcl6d/run/run_summary.h>
#include <pcl6d/run/run_writer.h>

#include <utility>

namespace pcl6d {

namespace {
FrameKind
kindOf(ScanState state)
{
  switch (state) {
  case ScanState::kMatched:
  case ScanState::kUnconverged:
    return FrameKind::kIcp;
  case ScanState::kFixed:
    return FrameKind::kInactive;
  case ScanState::kPredicted:
  case ScanState::kPending:
  case ScanState::kUnknown:
    break;
  }
  return FrameKind::kInvalid;
}

/** \return the poses of all scans, or of all sweeps of a drive, with stamps or indices */
Trajectory
trajectoryOf(const RunResult& run, const std::vector<double>& stamps)
{
  Trajectory all;
  if (!run.drive) {
    all.stamps = stamps;
    for (const ScanResult& scan : run.scans) {
      all.poses.push_back(scan.T_world_scan);
      if (stamps.empty())
        all.stamps.push_back(scan.index);
    }
    return all;
  }
  all.poses = run.drive->poses;
  all.stamps = run.drive->stamps;
  for (std::size_t i = all.stamps.size(); i < all.poses.size(); ++i)
    all.stamps.push_back(run.drive->first + static_cast<double>(i));
  return all;
}
} // namespace

RunWriter::RunWriter(std::filesystem::path folder, const RunResult& run)
: folder_(std::move(folder)), run_(run)
{}

/** \return the file of a scan in a subfolder, created if missing */
std::filesystem::path
RunWriter::in(const std::string& subfolder,
              std::size_t place,
              const std::string& extension) const
{
  std::filesystem::create_directories(folder_ / subfolder);
  return folder_ / subfolder / (scanName(run_.scans.at(place).index) + extension);
}

void
RunWriter::writePoses(const std::vector<double>& stamps) const
{
  Trajectory trajectory = trajectoryOf(run_, stamps);
  if (run_.moved)
    for (Eigen::Isometry3d& pose : trajectory.poses)
      pose = run_.moved->asGiven(pose);
  std::filesystem::create_directories(folder_);
  writeTrajectoryKitti(folder_ / "trajectory.kitti", trajectory);
  writeTrajectoryTum(folder_ / "trajectory.tum", trajectory);
  for (std::size_t i = 0; i < run_.scans.size(); ++i)
    writeFramesOf(i);
}

void
RunWriter::writeFramesOf(std::size_t place) const
{
  const ScanResult& scan = run_.scans[place];
  std::vector<Frame> frames = {{initialPoseOf(run_, place), FrameKind::kInvalid},
                               {scan.matched_pose, kindOf(scan.state)}};
  for (const StageResult& stage : run_.graph_stages)
    if (stage.kind != StageKind::kMatching)
      for (const auto& poses : stage.history)
        frames.push_back({poses[place],
                          stage.kind == StageKind::kLoopClosing ? FrameKind::kElch
                                                                : FrameKind::kLum});
  writeFrames(in("frames", place, ".frames"), frames);
}

void
RunWriter::writeGraph(const PoseGraph& graph) const
{
  PoseGraph named;
  named.links = graph.links;
  for (const ScanResult& scan : run_.scans) {
    named.poses.push_back(scan.T_world_scan);
    named.ids.push_back(static_cast<std::size_t>(scan.index));
  }
  writePoseGraphG2o(folder_ / "graph.g2o", named);
  writeRunLinks(folder_ / "links.csv", run_.links);
}

void
RunWriter::writeControl() const
{
  if (run_.control)
    writeControlTable(folder_ / "control.csv", run_);
}

void
RunWriter::writeVerification() const
{
  if (!run_.verification)
    return;
  std::vector<LinkCheck> links = run_.verification->links;
  for (LinkCheck& link : links) {
    link.from = static_cast<std::size_t>(run_.scans.at(link.from).index);
    link.to = static_cast<std::size_t>(run_.scans.at(link.to).index);
  }
  writeLinkChecks(folder_ / "verification.csv", links);
}

void
RunWriter::writeScan(std::size_t place, const pcl::PCLPointCloud2& cloud) const
{
  Eigen::Isometry3d pose = run_.scans.at(place).T_world_scan;
  pose.translation() -= run_.world_offset;
  writePcd(in("scans", place, ".pcd"), cloud, pose);
}

void
RunWriter::writeMap(const pcl::PCLPointCloud2& map) const
{
  writePcd(folder_ / "map.pcd", map);
}

void
RunWriter::writeMoving(const pcl::PCLPointCloud2& points) const
{
  writePcd(folder_ / "moving.pcd", points);
}

void
RunWriter::writeSummary() const
{
  writeRunSummary(folder_ / "summary.json", run_);
}

} // namespace pcl6d
