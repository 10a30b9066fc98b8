// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/run_program.h"

#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_summary.h>

#include <pcl/conversions.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pcl6d::test {

/** \brief The folder of a run whose poses are the truth, as pcl_slam6d would leave it, made
 * of simulated scans of furnished rooms: scans, map, summary and links. */
class SemanticRun {
public:
  static constexpr int kScans = 16;

  SemanticRun()
  {
    runProgram("pcl_slam6d_simulate",
               {"rooms",
                "-o",
                sim().string(),
                "--seed",
                "11",
                "--scans",
                std::to_string(kScans),
                "--quiet"});
    const Trajectory truth = readTrajectory(sim() / "groundtruth.txt");
    std::filesystem::create_directories(run() / "scans");
    RunResult summary;
    summary.generator = "pcl_slam6d";
    summary.options = {{"min-range", "0.1", "default", ""},
                       {"max-range", "50", "default", ""}};
    pcl::PointCloud<pcl::PointXYZ> map;
    std::vector<double> scan_of_point;
    for (int i = 0; i < kScans; ++i) {
      const Eigen::Isometry3d& pose = truth.poses[static_cast<std::size_t>(i)];
      const std::string name = scanName(i) + ".pcd";
      const Scan scan = readScan(sim() / name);
      writePcd(run() / "scans" / name, scan.cloud, pose);
      ScanResult& entry = summary.scans.emplace_back();
      entry.file = name;
      entry.index = i;
      entry.T_world_scan = pose;
      for (std::size_t k = 0; k < scan.points.size(); k += 5) {
        const Eigen::Vector3f p = (pose * scan.points[k].cast<double>()).cast<float>();
        map.push_back({p.x(), p.y(), p.z()});
        scan_of_point.push_back(i);
      }
    }
    pcl::PCLPointCloud2 cloud;
    pcl::toPCLPointCloud2(map, cloud);
    addField(cloud, "scan", pcl::PCLPointField::UINT32, scan_of_point);
    writePcd(run() / "map.pcd", cloud);
    writeRunSummary(run() / "summary.json", summary);
    writeText(
        run() / "links.csv",
        "from,to,kind,verdict,reason,distance,pairs,rms,overlap,condition,weight\n"
        "0,1,sequence,used,\"\",1,100,0.01,0.9,2,1\n"
        "0,9,loop,refused,\"too few, too far\",1,3,0.5,0.1,2,0\n");
  }

  std::filesystem::path
  sim() const
  {
    return folder_ / "sim";
  }
  std::filesystem::path
  run() const
  {
    return folder_ / "run";
  }
  std::filesystem::path
  operator/(const std::string& name) const
  {
    return folder_ / name;
  }

private:
  TempFolder folder_;
};

} // namespace pcl6d::test
