// SPDX-License-Identifier: BSD-3-Clause
#include "support/data_folder.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/slam6d/slam6d.h>

#include <pcl/io/pcd_io.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

namespace {
/** Poses in rows of twelve numbers, as KITTI has them. */
std::vector<Eigen::Isometry3d>
readRows(const std::filesystem::path& path)
{
  std::vector<Eigen::Isometry3d> poses;
  std::ifstream file(path);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  while (true) {
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        if (!(file >> pose.matrix()(row, column)))
          return poses;
    poses.push_back(pose);
  }
}

double
positionRms(const std::vector<Eigen::Isometry3d>& found,
            const std::vector<Eigen::Isometry3d>& truth)
{
  double sum_sq = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    sum_sq += (found[i].translation() - truth[i].translation()).squaredNorm();
  return std::sqrt(sum_sq / static_cast<double>(truth.size()));
}

// The bound of the project is 0.25 m; measured 0.032 m, and the reference itself is good
// to a few centimetres, so twice what was measured.
constexpr double kPositionRms = 0.06; // [m]
} // namespace

TEST(Slam6DData, MapsTheCampusLoop)
{
  PCL6D_DATA_OR_SKIP(folder, "hku1");
  const auto odometry = readRows(folder / "odometry.txt");
  const auto truth = readRows(folder / "groundtruth.txt");
  ASSERT_EQ(odometry.size(), 62u);
  ASSERT_EQ(truth.size(), 62u);
  ASSERT_GT(positionRms(odometry, truth), 2.5) << "the odometry drifts";

  pcl6d::Slam6D slam;
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    std::string number = std::to_string(i);
    number.insert(0, 3 - number.size(), '0');
    pcl::PointCloud<pcl::PointXYZI> cloud;
    ASSERT_EQ(
        pcl::io::loadPCDFile((folder / ("scan" + number + ".pcd")).string(), cloud), 0);
    slam.addScan(cloud, odometry[i]);
  }
  EXPECT_TRUE(slam.optimize());
  std::vector<Eigen::Isometry3d> found;
  for (const auto& scan : slam.result().scans)
    found.push_back(scan.T_world_scan);
  EXPECT_LT(positionRms(found, truth), kPositionRms);
  EXPECT_TRUE(slam.result().trusted());
}
