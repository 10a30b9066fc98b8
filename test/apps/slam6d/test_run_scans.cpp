// SPDX-License-Identifier: BSD-3-Clause
// Scans prepared for registration: deskewed along the motion within each of them.
#include "slam6d/input/run_scans.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace {
/** Writes a scan with a point (2, 0, 0) at the begin, the middle, three quarters and the end of
 * 0.1 s. */
void
writeTimedScan(const std::filesystem::path& file)
{
  std::ofstream(file) << "VERSION 0.7\nFIELDS x y z t\nSIZE 4 4 4 4\nTYPE F F F F\n"
                         "COUNT 1 1 1 1\nWIDTH 4\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
                         "POINTS 4\nDATA ascii\n"
                         "2 0 0 0\n2 0 0 0.05\n2 0 0 0.075\n2 0 0 0.1\n";
}

std::vector<float>
xOf(const pcl6d::Scan& scan)
{
  std::vector<float> x;
  for (const auto& point : scan.points)
    x.push_back(point.x());
  return x;
}
} // namespace

// The sensor stands until the middle of the sweep, then moves by 1 m. The poses of the scans would
// spread the motion over the sweep.
TEST(RunScans, AreDeskewedAlongTheirOwnPaths)
{
  const pcl6d::test::TempFolder path;
  writeTimedScan(path / "scan000.pcd");
  writeTimedScan(path / "scan001.pcd");
  std::ofstream(path / "times.txt") << "0\n0.1\n";
  std::ofstream(path / "odometry.txt") << "1 0 0 0 0 1 0 0 0 0 1 0\n"
                                          "1 0 0 1 0 1 0 0 0 0 1 0\n";
  const pcl6d::ScanFolder folder(path.path());
  pcl6d::Trajectory moving;
  for (const double x : {0, 0, 1}) {
    moving.stamps.push_back(0.05 * static_cast<double>(moving.stamps.size()));
    moving.poses.emplace_back(Eigen::Translation3d(x, 0, 0));
  }
  pcl6d::app::RunScans scans(folder);
  scans.deskew(pcl6d::MotionInterpolation::kLinear, {moving, {}});
  const std::vector<float> own = xOf(scans.read(0)), by_poses = xOf(scans.read(1));
  const std::vector<float> own_truth = {2, 2, 2.5f, 3}, spread = {2, 2.5f, 2.75f, 3};
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(own.at(k), own_truth[k], 1e-5) << k;
    EXPECT_NEAR(by_poses.at(k), spread[k], 1e-5) << k; // a scan without a path
  }
}
