// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/support/simulated_drive.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/trajectory_io.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace pcl6d::test {

/** Coarse scans of a flat, 0.6 m apart. */
inline const std::filesystem::path&
flatScans()
{
  static const std::filesystem::path path =
      sharedOutput("pcl_slam6d_simulate",
                   {"rooms", "--scans", "60", "--resolution", "3", "--quiet"});
  return path;
}

/** \brief A folder of simulated scans without poses, under other names. */
class DriveFolder {
public:
  explicit DriveFolder(const std::filesystem::path& path) : path_(path)
  {
    std::filesystem::create_directory(path_);
  }

  /** Copies a scan of a simulated folder. \param[in] viewpoint replaces its VIEWPOINT */
  void
  add(const std::filesystem::path& simulated,
      int index,
      const std::string& name,
      const std::string& viewpoint = "0 0 0 1 0 0 0")
  {
    std::string scan = readText(simulated / (scanName(index) + ".pcd"));
    const std::size_t begin = scan.find("VIEWPOINT ");
    ASSERT_NE(begin, std::string::npos);
    scan.replace(begin, scan.find('\n', begin) - begin, "VIEWPOINT " + viewpoint);
    writeText(path_ / name, scan);
    truth_[name] = readTrajectory(simulated / "groundtruth.txt")
                       .poses.at(static_cast<std::size_t>(index));
  }

  /** \return [m] the largest error of a scan of a run, relative to its first scan */
  double
  largestError(const std::filesystem::path& run) const
  {
    const auto summary = nlohmann::json::parse(readText(run / "summary.json"));
    const auto& scans = summary["scans"];
    const Eigen::Isometry3d found = poseOf(scans[0]).inverse();
    const Eigen::Isometry3d truth = truth_.at(scans[0]["file"]).inverse();
    double largest = 0;
    for (const auto& scan : scans)
      largest = std::max(
          largest,
          distanceBetween(truth * truth_.at(scan["file"]), found * poseOf(scan))
              .translation);
    return largest;
  }

  const std::filesystem::path&
  path() const
  {
    return path_;
  }

private:
  static Eigen::Isometry3d
  poseOf(const nlohmann::json& scan)
  {
    const auto rows = scan["T_world_scan"].get<std::vector<double>>();
    Eigen::Isometry3d pose;
    pose.matrix() =
        Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(rows.data());
    return pose;
  }

  std::filesystem::path path_;
  std::map<std::string, Eigen::Isometry3d> truth_; ///< T_world_scan of each name
};

} // namespace pcl6d::test
