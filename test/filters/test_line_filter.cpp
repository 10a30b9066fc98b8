// SPDX-License-Identifier: BSD-3-Clause
// Filters along the lines of scans as they come from files of rows.
#include "support/points.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/filters/line_filter.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>

#include <pcl/conversions.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <gtest/gtest.h>

#include <limits>

namespace {
using pcl6d::Points;
using pcl6d::Scan;
using pcl6d::test::kNan;
using pcl6d::test::TempFolder;

/** Rows of a wall 5 m ahead, points 0.2 m apart, as a file and read again. */
class LineFilters : public testing::Test {
protected:
  LineFilters()
  {
    cloud_.resize(11, 3);
    for (std::uint32_t row = 0; row < cloud_.height; ++row)
      for (std::uint32_t i = 0; i < cloud_.width; ++i)
        cloud_(i, row) = {5.f, 0.2f * static_cast<float>(i), static_cast<float>(row)};
  }

  Scan
  read() const
  {
    const TempFolder folder;
    pcl::PCLPointCloud2 cloud;
    pcl::toPCLPointCloud2(cloud_, cloud);
    cloud.is_dense = false;
    pcl6d::writePcd(folder / "scan.pcd", cloud);
    return pcl6d::readScan(folder / "scan.pcd");
  }

  pcl::PointCloud<pcl::PointXYZ> cloud_;
};
} // namespace

TEST_F(LineFilters, MoveAMixedPixelAlongItsRayAndNothingElse)
{
  cloud_(4, 1).getVector3fMap() *= 2; // hangs behind the wall
  const Scan before = read();
  Scan scan = before;
  pcl6d::filterByMedian(scan);
  for (std::size_t i = 0; i < scan.points.size(); ++i)
    if (i != 11 + 4) {
      EXPECT_EQ(scan.points[i], before.points[i]) << i;
    }
  const Eigen::Vector3f moved = scan.points[11 + 4], was = before.points[11 + 4];
  EXPECT_LT(moved.cross(was).norm(), 1e-5); // [m^2] on its ray
  EXPECT_NEAR(moved.norm(), was.norm() / 2, 0.1);
  EXPECT_EQ(pcl6d::coordinatesOf(scan.cloud), scan.points);
}

TEST_F(LineFilters, KeepThePlaceOfPointsWithoutEcho)
{
  // Without the gap, 0 and 2 of a row were neighbours; without rows, its end and the next.
  for (std::uint32_t row = 0; row < 3; ++row)
    cloud_(1, row).x = kNan;
  const Scan scan = read();
  EXPECT_EQ(scan.row_length, 11u);
  ASSERT_EQ(scan.places.size(), 30u);
  EXPECT_EQ(scan.places[1], 2u);
  EXPECT_EQ(scan.places[10], 11u);
  Scan merged = scan;
  pcl6d::ScanLineReductionOptions options;
  options.max_distance = 0.3; // pairs: 0, 2 3, 4 5, 6 7, 8 9, 10
  pcl6d::reduceLines(merged, options);
  ASSERT_EQ(merged.points.size(), 18u);
  EXPECT_EQ(merged.points[0], scan.points[0]);
  EXPECT_LT((merged.points[1] - (scan.points[1] + scan.points[2]) / 2).norm(), 1e-6);
  EXPECT_EQ(merged.cloud.width, scan.cloud.width); // the cloud stays
}

TEST_F(LineFilters, LeaveNoReturnCodesAlone)
{
  cloud_.resize(101, 3);
  for (auto& p : cloud_)
    p = {5, 0, 0};
  for (std::size_t i = 3; i < 303; i += 25) // twelve: more than 0.5 %, and than 10
    cloud_[i] = {80, 0, 0};
  const Scan before = read();
  Scan scan = before;
  pcl6d::filterByMedian(scan);
  EXPECT_EQ(scan.points, before.points); // not made part of the wall
  pcl6d::reduceLines(scan);
  for (const auto& p : scan.points)
    EXPECT_LT(p.norm(), 6);
}

TEST_F(LineFilters, AskForLines)
{
  cloud_.width = 33;
  cloud_.height = 1;
  Scan scan = read();
  EXPECT_EQ(scan.row_length, 0u);
  EXPECT_THROW(pcl6d::filterByMedian(scan), pcl6d::BadArgument);
  EXPECT_THROW(pcl6d::reduceLines(scan), pcl6d::BadArgument);
  scan = read();
  scan.row_length = 11;
  scan.places = {0, 1};
  EXPECT_THROW(pcl6d::reduceLines(scan), pcl6d::BadArgument);
  Scan none;
  none.row_length = 11;
  pcl6d::reduceLines(none);
  EXPECT_TRUE(none.points.empty());
}

TEST(LineFilterNames, AreThoseOfTheFilters)
{
  for (const auto& name : pcl6d::lineFilterNames())
    EXPECT_EQ(toString(pcl6d::lineFilterFromName(name)), name);
  EXPECT_EQ(pcl6d::lineFilterNames().size(), 4u);
  EXPECT_THROW(pcl6d::lineFilterFromName("median"), pcl6d::BadArgument);
}
