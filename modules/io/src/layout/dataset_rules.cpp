// SPDX-License-Identifier: BSD-3-Clause
// Sources: the pages and development kits of the data sets. KITTI: A. Geiger et al., IJRR 2013;
// KITTI-360: Y. Liao et al., PAMI 2022; MulRan: G. Kim et al., ICRA 2020; HeLiPR: M. Jung et al.,
// IJRR 2024; NCLT: N. Carlevaris-Bianco et al., IJRR 2016; Newer College: M. Ramezani et al., IROS
// 2020; Boreas: K. Burnett et al., IJRR 2023; nuScenes: H. Caesar et al., CVPR 2020; Oxford Spires:
// Y. Tao et al., IJRR 2025.
#include "layout/dataset_rules.h"
#include "layout/name_stamp.h"

#include <algorithm>
#include <cctype>

namespace pcl6d::io {

namespace {
constexpr const char* kForward = "x forward, y left, z up [m]";
constexpr const char* kSensor = "axes of the sensor, z up [m]";
constexpr const char* kOfAzimuth =
    "from the azimuth: clockwise, stamped when facing forward";
constexpr const char* kDeskewed = "none: sweeps are deskewed already";
constexpr const char* kUnknown = "none";

std::vector<DatasetRule>
rulesOfKitti()
{
  return {{"KITTI odometry",
           {"velodyne"},
           ".bin",
           ScanNames::kNumber,
           {"times.txt", "calib.txt"},
           nullptr,
           BinLayout::kXyzi,
           kForward,
           "times.txt",
           "calib.txt",
           {"../../poses/*.txt"},
           PointTimeRule::kNone,
           kDeskewed},
          {"KITTI-360",
           {"velodyne_points/data"},
           ".bin",
           ScanNames::kNumber,
           {},
           "data_3d_raw",
           BinLayout::kXyzi,
           kForward,
           "velodyne_points/timestamps.txt",
           "../../calibration/calib_cam_to_velo.txt",
           {"../../data_poses/*/poses.txt"},
           PointTimeRule::kAzimuth,
           kOfAzimuth},
          {"KITTI raw",
           {"velodyne_points/data"},
           ".bin",
           ScanNames::kNumber,
           {"velodyne_points/timestamps.txt", "oxts"},
           nullptr,
           BinLayout::kXyzi,
           kForward,
           "velodyne_points/timestamps.txt",
           "../calib_velo_to_cam.txt",
           {"oxts/data"},
           PointTimeRule::kAzimuth,
           kOfAzimuth}};
}

DatasetRule
ruleOfHelipr(const char* name,
             const char* scans,
             BinLayout layout,
             const char* reference)
{
  return {name,
          {scans},
          ".bin",
          ScanNames::kNanoseconds,
          {},
          nullptr,
          layout,
          kSensor,
          nullptr,
          nullptr,
          {reference},
          PointTimeRule::kNone,
          "in the files"};
}

std::vector<DatasetRule>
rulesOfHelipr()
{
  return {ruleOfHelipr("HeLiPR (Avia)",
                       "LiDAR/Avia",
                       BinLayout::kHeliprAvia,
                       "LiDAR_GT/Avia_gt.txt"),
          ruleOfHelipr("HeLiPR (Aeva)",
                       "LiDAR/Aeva",
                       BinLayout::kHeliprAeva,
                       "LiDAR_GT/Aeva_gt.txt"),
          ruleOfHelipr("HeLiPR (Ouster)",
                       "LiDAR/Ouster",
                       BinLayout::kHeliprOuster,
                       "LiDAR_GT/Ouster_gt.txt"),
          ruleOfHelipr("HeLiPR (Velodyne)",
                       "LiDAR/Velodyne",
                       BinLayout::kHeliprVelodyne,
                       "LiDAR_GT/Velodyne_gt.txt")};
}

/** Layouts with scans in .bin files named by time stamps. */
std::vector<DatasetRule>
rulesOfStampedBins()
{
  return {{"MulRan",
           {"sensor_data/Ouster", "Ouster"},
           ".bin",
           ScanNames::kNanoseconds,
           {},
           nullptr,
           BinLayout::kXyzi,
           kSensor,
           nullptr,
           nullptr,
           {"global_pose.csv"},
           PointTimeRule::kColumns,
           "from the order: 1024 columns of 64 points a turn"},
          {"NCLT",
           {"velodyne_sync"},
           ".bin",
           ScanNames::kMicroseconds,
           {},
           nullptr,
           BinLayout::kNclt,
           "x forward, y left, z up [m], converted from y right, z down",
           nullptr,
           nullptr,
           {"groundtruth_*.csv", "../groundtruth_*.csv"},
           PointTimeRule::kNone,
           kUnknown},
          {"Boreas",
           {"lidar"},
           ".bin",
           ScanNames::kMicroseconds,
           {"applanix", "calib"},
           nullptr,
           BinLayout::kXyzirt,
           kSensor,
           nullptr,
           "calib",
           {"applanix/lidar_poses.csv"},
           PointTimeRule::kNone,
           "in the files"},
          {"nuScenes",
           {"sweeps/LIDAR_TOP", "samples/LIDAR_TOP"},
           ".bin",
           ScanNames::kMicroseconds,
           {},
           nullptr,
           BinLayout::kXyzir,
           "x right, y forward, z up [m]",
           nullptr,
           nullptr,
           {"v1.0-trainval", "v1.0-mini", "v1.0-test"},
           PointTimeRule::kNone,
           kUnknown}};
}

std::vector<DatasetRule>
rulesOfPcd()
{
  return {
      {"Newer College",
       {"raw_format/ouster_scan", "ouster_scan"},
       ".pcd",
       ScanNames::kSecondsNanoseconds,
       {},
       nullptr,
       BinLayout::kAuto,
       kSensor,
       nullptr,
       nullptr,
       {"ground_truth/registered_poses.csv", "../ground_truth/registered_poses.csv"},
       PointTimeRule::kNone,
       "in the files"},
      {"Oxford Spires",
       {"raw/lidar-clouds", "lidar-clouds"},
       ".pcd",
       ScanNames::kDecimal,
       {},
       nullptr,
       BinLayout::kAuto,
       kSensor,
       nullptr,
       nullptr,
       {"processed/trajectory/gt-tum.txt", "gt-tum.txt"},
       PointTimeRule::kNone,
       "in the files"},
      {"Oxford Spires",
       {"processed/vilens-slam/undist-clouds"},
       ".pcd",
       ScanNames::kSecondsNanoseconds,
       {},
       nullptr,
       BinLayout::kAuto,
       kSensor,
       nullptr,
       nullptr,
       {"processed/trajectory/gt-tum.txt"},
       PointTimeRule::kNone,
       kDeskewed}};
}
} // namespace

const std::vector<DatasetRule>&
datasetRules()
{
  static const std::vector<DatasetRule> rules = [] {
    std::vector<DatasetRule> all = rulesOfKitti();
    for (const auto& part : {rulesOfHelipr(), rulesOfStampedBins(), rulesOfPcd()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return rules;
}

bool
isNamed(const std::filesystem::path& scan, ScanNames kind)
{
  if (kind != ScanNames::kNumber) {
    const auto stamp = stampOfName(scan);
    return stamp && stamp->kind == kind;
  }
  const std::string stem = scan.stem().string();
  return !stem.empty() && std::all_of(stem.begin(), stem.end(), [](unsigned char c) {
    return std::isdigit(c) != 0;
  });
}

} // namespace pcl6d::io
