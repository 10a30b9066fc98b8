// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/run_program.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/frames_io.h>
#include <pcl6d/io/object_io.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/plane_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/run/run_links_io.h>
#include <pcl6d/run/run_summary.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::test {

/** The walls and the floor of a room of 6 m x 4 m, seen from its middle. */
inline pcl::PCLPointCloud2
roomCloud(const std::vector<double>& shift_x)
{
  pcl::PointCloud<pcl::PointXYZ> cloud;
  std::vector<double> scans, intensities;
  for (std::size_t scan = 0; scan < shift_x.size(); ++scan)
    for (float a = -3; a <= 3; a += 0.1F)
      for (float b = -2; b <= 2; b += 0.1F) {
        const auto shift = static_cast<float>(shift_x[scan]);
        cloud.push_back({a - shift, b, -1});
        cloud.push_back({a - shift, 2, b / 2});
        for (int i = 0; i < 2; ++i) {
          scans.push_back(static_cast<double>(scan));
          intensities.push_back(a + b + 5);
        }
      }
  pcl::PCLPointCloud2 result;
  pcl::toPCLPointCloud2(cloud, result);
  addField(result, "scan", pcl::PCLPointField::UINT32, scans);
  addField(result, "intensity", pcl::PCLPointField::FLOAT32, intensities);
  return result;
}

/** A whole run: three scans 1 m apart, two planes, an object. */
struct RoomRun : TempFolder {
  static constexpr int kScans = 3;

  RoomRun()
  {
    RunResult summary;
    summary.generator = "pcl_slam6d";
    Trajectory trajectory;
    std::vector<RunLink> links;
    std::filesystem::create_directories(*this / "run/frames");
    std::filesystem::create_directories(*this / "run/scans");
    for (int i = 0; i < kScans; ++i) {
      ScanResult scan;
      scan.file = scanName(i) + ".pcd";
      scan.index = i;
      scan.T_world_scan = planarPose(i - 1, 0, 0);
      scan.initial_pose = planarPose(i - 1, 0.3 * i, 0.1 * i);
      scan.state = i == 2 ? ScanState::kPredicted : ScanState::kMatched;
      scan.correction = 0.1 * i;
      scan.covariance = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
      summary.scans.push_back(scan);
      trajectory.poses.push_back(scan.T_world_scan);
      writeFrames(*this / ("run/frames/" + scanName(i) + ".frames"),
                  {{scan.initial_pose, FrameKind::kInvalid},
                   {scan.T_world_scan, FrameKind::kIcp}});
      writePcd(*this / ("run/scans/" + scanName(i) + ".pcd"), roomCloud({i - 1.0}));
    }
    links.push_back(
        {0, 1, LinkKind::kSequence, LinkVerdict::kUsed, {}, 1, 9, 0.02, 0.9, 0.5, 1});
    links.push_back({1,
                     2,
                     LinkKind::kSequence,
                     LinkVerdict::kRefused,
                     pcl6d::Rejection::stated("few pairs"),
                     1,
                     2,
                     0.4,
                     0.1,
                     0.5,
                     0});
    writeRunSummary(run() / "summary.json", summary);
    writeTrajectoryKitti(run() / "trajectory.kitti", trajectory);
    writeRunLinks(run() / "links.csv", links);
    writeText(run() / "graph.g2o", "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n");
    writePcd(run() / "map.pcd", roomCloud({0, 0, 0}));
    writePlanesAndObjects();
  }

  void
  writePlanesAndObjects() const
  {
    Plane floor;
    floor.normal = -Eigen::Vector3d::UnitZ();
    floor.offset = 1;
    floor.label = "floor";
    floor.area = 24;
    floor.hull = {{-3, -2, -1}, {-3, 2, -1}, {3, 2, -1}, {3, -2, -1}};
    writePlanes(run() / "planes.json", {floor});
    pcl::PCLPointCloud2 cloud = roomCloud({0});
    std::vector<double> ids;
    for (std::size_t i = 0; i < cloud.width; ++i)
      ids.push_back(i % 2 == 0 ? 1 : 0);
    addField(cloud, "plane_id", pcl::PCLPointField::UINT32, ids);
    writePcd(run() / "planes.pcd", cloud);
    ObjectPose chair;
    chair.object_class = "chair";
    chair.T_world_object = planarPose(1, 0, 0.4);
    chair.box = Eigen::AlignedBox3d(Eigen::Vector3d(-0.3, -0.3, -1),
                                    Eigen::Vector3d(0.3, 0.3, 0));
    writeObjects(run() / "objects.json", {chair});
  }

  std::filesystem::path
  run() const
  {
    return *this / "run";
  }
  std::string
  out(const std::string& name) const
  {
    return *this / name;
  }
};

inline const RoomRun&
room()
{
  static const RoomRun run;
  return run;
}

/** \return width and height of a PNG file, from its header */
inline std::pair<unsigned int, unsigned int>
sizeOfPng(const std::filesystem::path& file)
{
  const std::string bytes = readText(file);
  if (bytes.size() < 26 || bytes.compare(1, 3, "PNG") != 0)
    return {0, 0};
  const auto number = [&](std::size_t at) {
    unsigned int value = 0;
    for (std::size_t i = at; i < at + 4; ++i)
      value = 256 * value + static_cast<unsigned char>(bytes[i]);
    return value;
  };
  return {number(16), number(20)};
}

} // namespace pcl6d::test
