// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/report.h>

#include <string>

namespace pcl6d::test {

inline const Eigen::Vector3d kReportOffset(500000, 5400000, 0); // [m] world offset

/** The smallest picture: one pixel. */
inline const std::string
    kPng("\x89PNG\r\n\x1a\n"
         "\x00\x00\x00\x0d"
         "IHDR\x00\x00\x00\x01\x00\x00\x00\x01\x08\x02\x00\x00\x00\x90\x77\x53\xde"
         "\x00\x00\x00\x0c"
         "IDAT\x78\x9c\x63\xf8\xdf\xa0\x00\x00\x04\x21\x01\xa0\x4d\xbf\x32\x90"
         "\x00\x00\x00\x00"
         "IEND\xae\x42\x60\x82",
         69);

/** \return a floor of 20 m x 20 m and a wall, seen from scans on a line */
inline RunMap
makeReportMap(std::uint32_t scans)
{
  RunMap map;
  for (int i = 0; i < 40; ++i)
    for (int k = 0; k < 40; ++k) {
      map.points.emplace_back(0.5F * i, 0.5F * k, 0.01F * k);
      map.points.emplace_back(0.5F * i, 20.0F, 0.1F * k);
      for (int twice = 0; twice < 2; ++twice) {
        map.scans.push_back(static_cast<std::uint32_t>(i) * scans / 40);
        map.intensities.push_back(static_cast<float>(k));
      }
    }
  return map;
}

inline ScanResult
makeReportScan(int index)
{
  ScanResult scan;
  scan.file = "scan" + std::to_string(index) + ".pcd";
  scan.index = index;
  scan.initial_pose.translation() = kReportOffset + Eigen::Vector3d(2 * index, 9, 1);
  scan.T_world_scan.translation() = kReportOffset + Eigen::Vector3d(2 * index, 10, 1);
  scan.covariance = Eigen::Matrix<double, 6, 6>::Identity() * 1e-4;
  scan.state = index == 0 ? ScanState::kFixed : ScanState::kMatched;
  scan.status = Status::kOk;
  scan.points = 1000 + static_cast<std::size_t>(index);
  scan.pairs = 500;
  scan.rms = 0.01 * (1 + index % 3);
  scan.overlap = 0.5 + 0.05 * (index % 4);
  scan.iterations = 7 + index % 5;
  scan.correction = 0.02 * (index % 7);
  return scan;
}

/** \return a run with all that a report can tell: one scan is not to be trusted, one link
 * refused */
inline ReportData
makeReportData(int scans = 10)
{
  ReportData data;
  data.title = "a run";
  data.summary.generator = "pcl_slam6d";
  data.summary.version = "0.1.0";
  data.summary.world_offset = kReportOffset;
  data.summary.pose_source = "odometry.txt";
  data.summary.trusted = false;
  data.summary.options = {{"voxel", "0.1", "derived", "from the spacing"},
                          {"min-overlap", "0.1", "given", ""}};
  data.summary.stages = {{"reading", 1.5, 100}, {"matching", 3.5, 200}};
  data.summary.graph_stages = {
      {StageKind::kRelaxation, true, Rejection::stated("no gain"), 0.5, 0.5, 3, 1, {}}};
  for (int i = 0; i < scans; ++i)
    data.summary.scans.push_back(makeReportScan(i));
  data.summary.scans.back().state = ScanState::kPredicted;
  data.summary.scans.back().rejections = {
      Rejection::stated("overlap below --min-overlap")};
  for (std::size_t i = 1; i < data.summary.scans.size(); ++i)
    data.summary.links.push_back({i - 1,
                                  i,
                                  LinkKind::kSequence,
                                  LinkVerdict::kUsed,
                                  {},
                                  2,
                                  400,
                                  0.02,
                                  0.5,
                                  0.1,
                                  1});
  data.summary.links.push_back({0,
                                data.summary.scans.size() - 1,
                                LinkKind::kLoop,
                                LinkVerdict::kRefused,
                                Rejection::stated("too few pairs"),
                                18,
                                3,
                                0.3,
                                0.01,
                                0,
                                0});
  data.map = makeReportMap(static_cast<std::uint32_t>(scans));
  Plane floor;
  floor.label = "floor";
  for (const auto& [x, y] : {std::pair(0, 0), {20, 0}, {20, 20}, {0, 20}})
    floor.hull.push_back(kReportOffset + Eigen::Vector3d(x, y, 0));
  data.planes = {floor};
  ObjectPose chair;
  chair.object_class = "chair";
  chair.T_world_object.translation() = kReportOffset + Eigen::Vector3d(5, 5, 0);
  chair.box = {Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(1, 1, 2)};
  data.objects = {chair};
  data.pictures = {{"top_view.png", "from above", kPng}};
  return data;
}

constexpr std::size_t kWalkerPoints = 2000; // in the moving map of makeMovingReport()

/** \return the same run with somebody who walks over the floor beside the scanner, seen by its first
 * five scans */
inline ReportData
makeMovingReport(int scans = 10)
{
  ReportData data = makeReportData(scans);
  for (std::size_t i = 0; i < kWalkerPoints; ++i) {
    const float step = static_cast<float>(i / 20), height = static_cast<float>(i % 20);
    data.moving.points.emplace_back(2 + 0.16F * step, 5.0F, 0.1F + 0.09F * height);
    data.moving.scans.push_back(static_cast<std::uint32_t>(i * 5 / kWalkerPoints));
  }
  MovingResult moving;
  moving.points.assign(data.summary.scans.size(), 0);
  for (std::size_t i = 0; i < 5; ++i)
    moving.points[i] = 40 + i;
  moving.unknown = 0.25;
  data.summary.moving = moving;
  return data;
}

} // namespace pcl6d::test
