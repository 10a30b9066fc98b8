// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz/fuzz_target.h"
#include "fuzz/targets.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/control_points_io.h>
#include <pcl6d/io/frames_io.h>
#include <pcl6d/io/link_list_io.h>
#include <pcl6d/io/pose_graph_io.h>
#include <pcl6d/io/trajectory_formats.h>
#include <pcl6d/io/trajectory_io.h>

namespace pcl6d::fuzz {

namespace {
void
expectRigid(const Eigen::Isometry3d& pose)
{
  // Readers make rotations rigid to some ulp; this is far above and far below any fault.
  constexpr double kTolerance = 1e-9;
  expect(pose.matrix().allFinite(), "poses are finite");
  const Eigen::Matrix3d R = pose.linear();
  expect((R.transpose() * R).isIdentity(kTolerance), "rotations are rigid");
  expect(R.determinant() > 0, "rotations do not mirror");
}

void
expectIncreasing(const std::vector<double>& stamps)
{
  for (std::size_t i = 1; i < stamps.size(); ++i)
    expect(stamps[i - 1] < stamps[i], "stamps increase");
}
} // namespace

int
trajectory(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".txt", data, size, [](const auto& file) {
    const Trajectory read = readTrajectoryFiles(file).trajectory;
    expect(!read.poses.empty(), "a trajectory has a pose");
    expect(read.stamps.empty() || read.stamps.size() == read.poses.size(),
           "a stamp per pose");
    for (const auto& pose : read.poses)
      expectRigid(pose);
    expectIncreasing(read.stamps);
  });
}

int
stamps(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(
      ".txt", data, size, [](const auto& file) { expectIncreasing(readStamps(file)); });
}

int
uos_pose(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(
      ".pose", data, size, [](const auto& file) { expectRigid(readUosPose(file)); });
}

int
frames(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".frames", data, size, [](const auto& file) {
    for (const Frame& frame : readFrames(file))
      expectRigid(frame.T_world_scan);
  });
}

int
pose_graph(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".g2o", data, size, [](const auto& file) {
    const PoseGraph graph = readPoseGraph(file);
    expect(!graph.poses.empty(), "a graph has a pose");
    for (const auto& pose : graph.poses)
      expectRigid(pose);
    for (const auto& link : graph.links)
      expect(link.from < graph.poses.size() && link.to < graph.poses.size(),
             "links are between poses");
    // What was read can be written, and is the same again.
    const auto copy = file.parent_path() / "copy.g2o";
    try {
      writePoseGraphG2o(copy, graph);
      const PoseGraph again = readPoseGraph(copy);
      expect(again.poses.size() == graph.poses.size(), "as many poses as before");
      expect(again.links.size() == graph.links.size(), "as many links as before");
    } catch (const BadArgument& e) {
      throw Finding(std::string("a graph was read that cannot be written: ") +
                    e.what());
    }
  });
}

int
link_list(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".txt", data, size, [](const auto& file) {
    for (const auto& [from, to] : readLinkList(file))
      expect(from != to, "no link of a scan to itself");
  });
}

int
control_points(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".csv", data, size, [](const auto& file) {
    for (const auto& point : readControlPoints(file)) {
      expect(point.position.allFinite(), "finite coordinates");
      expect(!point.sigma || *point.sigma > 0, "sigma above 0");
    }
  });
}

int
scan_targets(const std::uint8_t* data, std::size_t size)
{
  return readAsFile(".csv", data, size, [](const auto& file) {
    for (const auto& target : readScanTargets(file, {"scan000.pcd", "b.pcd"}, {0, 7})) {
      expect(target.position.allFinite(), "finite coordinates");
      expect(target.scan < 2, "a scan that is there");
    }
  });
}

} // namespace pcl6d::fuzz
