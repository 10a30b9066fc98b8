// SPDX-License-Identifier: BSD-3-Clause
#include "support/data_folder.h"

#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/scan_line.h>
#include <pcl6d/io/scan_reader.h>

#include <algorithm>

namespace {
constexpr std::size_t kLineLength = 360; // values a line of Kurt3D's scans

pcl6d::Points
kurt3dScan(const std::filesystem::path& folder)
{
  return pcl6d::readScan(folder / "scan000.3d").points;
}
} // namespace

TEST(Kurt3d, TheMedianMovesAFewPoints)
{
  PCL6D_DATA_OR_SKIP(folder, "kurt3d");
  const pcl6d::Points scan = kurt3dScan(folder);
  const pcl6d::Points filtered = pcl6d::medianAlongLines(scan, kLineLength);
  ASSERT_EQ(filtered.size(), scan.size());
  std::size_t moved = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    moved += filtered[i] != scan[i];
    // Along the ray: no part of the way is across it.
    const Eigen::Vector3d a = scan[i].cast<double>(), b = filtered[i].cast<double>();
    EXPECT_LE(a.cross(b).norm(), 1e-6 * a.norm() * b.norm());
  }
  RecordProperty("moved", std::to_string(moved));
  EXPECT_GT(moved, 0u);
  EXPECT_LT(moved, scan.size() / 20);
}

TEST(Kurt3d, TheReductionLeavesAboutATenth)
{
  PCL6D_DATA_OR_SKIP(folder, "kurt3d");
  const pcl6d::Points scan = kurt3dScan(folder);
  pcl6d::ScanLineReductionOptions options;
  const auto share = [&](double max_distance) {
    options.max_distance = max_distance; // [m]
    const auto reduced = pcl6d::reduceAlongLines(scan, kLineLength, options);
    return static_cast<double>(reduced.size()) / static_cast<double>(scan.size());
  };
  // Literature: 66 785 -> 6 700 points. This corridor is narrower and needs a larger
  // limit for as few; measured 0.186 and 0.098.
  EXPECT_NEAR(share(0.2), 0.19, 0.02);
  const double all_lines = share(0.5);
  EXPECT_NEAR(all_lines, 0.10, 0.02);
  options.line_step = 3; // 76 of 226 lines
  EXPECT_NEAR(share(0.5) / all_lines, 76.0 / 226, 0.02);
}
