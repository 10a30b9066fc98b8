// SPDX-License-Identifier: BSD-3-Clause
// Kurt3D's recorded scans: 226 lines of 360 values, in the order of acquisition.
#include "support/constants.h"
#include "support/data_folder.h"

#include <pcl6d/io/scan_reader.h>
#include <pcl6d/scanner/driven_scanner_projection.h>
#include <pcl6d/scanner/range_image.h>

#include <algorithm>
#include <cmath>

namespace {
using pcl6d::Pixel;
using pcl6d::Points;
using pcl6d::RangeImage;
using pcl6d::test::kDegree;

constexpr double kNear = 0.15;      // [m] nearer: no return, or the robot itself
constexpr double kFar = 32.7;       // [m] farther: no return
constexpr double kTolerance = 1e-3; // [m]
constexpr std::size_t kCols = 360;

/** The mirror turns from the right by 0.5 deg a sample; the drive goes up, from looking
 * 48.7 deg down to 67.6 deg up, in equal steps within 0.0007 deg. */
std::shared_ptr<const pcl6d::DrivenScannerProjection>
kurt3d()
{
  pcl6d::DrivenScannerOptions options;
  options.drive = pcl6d::Drive::kPitching;
  options.beam = {-90 * kDegree, 89.5 * kDegree, 360};
  options.theta = {-48.7 * kDegree, 67.6 * kDegree, 226};
  return std::make_shared<pcl6d::DrivenScannerProjection>(options);
}

Points
readPoints(const std::filesystem::path& folder, int scan)
{
  return pcl6d::readScan(folder / ("scan00" + std::to_string(scan) + ".3d")).points;
}

bool
isReturn(const Eigen::Vector3f& p)
{
  return p.norm() >= kNear && p.norm() <= kFar;
}

pcl6d::RangeImageOptions
returnsOnly()
{
  pcl6d::RangeImageOptions options;
  options.min_range = kNear;
  options.max_range = kFar;
  return options;
}
} // namespace

TEST(Kurt3D, IsOrganizedInOrderAndGivesBackItsPoints)
{
  PCL6D_DATA_OR_SKIP(folder, "kurt3d");
  for (int scan = 0; scan < 3; ++scan) {
    const Points points = readPoints(folder, scan);
    const auto image = RangeImage::inOrder(points, kurt3d(), returnsOnly());
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Pixel pixel{static_cast<int>(i / kCols), static_cast<int>(i % kCols)};
      ASSERT_EQ(std::isfinite(image.range(pixel)), isReturn(points[i])) << i;
      if (isReturn(points[i]))
        worst =
            std::max(worst, (image.position(pixel) - points[i].cast<double>()).norm());
    }
    RecordProperty("worst_mm_" + std::to_string(scan), std::to_string(1e3 * worst));
    EXPECT_LT(worst, kTolerance);
  }
}

// As if the order were lost. What the model cannot tell apart is the first column: there
// the beam runs along the axis of the drive, so all 226 lines look the same way.
TEST(Kurt3D, IsOrganizedByDirectionAlone)
{
  PCL6D_DATA_OR_SKIP(folder, "kurt3d");
  for (int scan = 0; scan < 3; ++scan) {
    const Points points = readPoints(folder, scan);
    Points turned(points.rbegin(), points.rend());
    const auto image = RangeImage::project(turned, kurt3d(), returnsOnly());
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Pixel pixel{static_cast<int>(i / kCols), static_cast<int>(i % kCols)};
      const auto found = image.pixelOf(points.size() - 1 - i);
      ASSERT_EQ(found.has_value(), isReturn(points[i])) << i;
      if (!found || pixel.col == 0)
        continue;
      ASSERT_EQ(*found, pixel) << i << ": " << found->row << ' ' << found->col;
      ASSERT_EQ(image.pointsAt(pixel).size(), 1u);
      worst =
          std::max(worst, (image.position(pixel) - points[i].cast<double>()).norm());
    }
    EXPECT_LT(worst, kTolerance);
    const auto axis = image.pointsIn({{0, 0}, {225, 0}});
    for (const auto i : axis)
      EXPECT_EQ(image.pixelOf(i)->col, 0) << i;
  }
}
