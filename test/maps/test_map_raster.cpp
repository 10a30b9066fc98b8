// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/maps/map_raster.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace {
using pcl6d::MapExtent;
using pcl6d::MappedScan;
using pcl6d::MapRaster;

MapExtent
extentOf(const pcl6d::Points& points, const Eigen::Vector3f& origin)
{
  MappedScan scan;
  scan.points = points;
  scan.origin = origin;
  MapExtent extent;
  extent.add(scan);
  return extent;
}

TEST(MapRaster, CoversPointsAndScannersInWholeCells)
{
  const MapRaster raster =
      extentOf({{0.3F, -0.1F, 9}, {1, 0.2F, 0}}, {-0.6F, 0, 0}).raster(0.5, 100);
  EXPECT_EQ(raster.corner, Eigen::Vector2d(-1, -0.5));
  EXPECT_EQ(raster.columns, 5u); // from -1 to 1.5, as 1 begins a cell
  EXPECT_EQ(raster.rows, 2u);
  EXPECT_EQ(raster.indexOf(-0.6, -0.1), 0u);
  EXPECT_EQ(raster.indexOf(1, 0.2), 9u);
  EXPECT_EQ(raster.centreOf(9), Eigen::Vector2d(1.25, 0.25));
  for (const auto& [x, y] :
       {std::pair(-1.1, 0.0), {1.6, 0.0}, {0.0, -0.6}, {0.0, 0.6}, {NAN, 0.0}})
    EXPECT_EQ(raster.indexOf(x, y), raster.size()) << x << ' ' << y;
}

TEST(MapRaster, TooManyCellsAreRefusedWithTheEdgeThatFits)
{
  const MapExtent extent = extentOf({{0, 0, 0}, {99.95F, 49.95F, 0}}, {1, 1, 1});
  try {
    extent.raster(0.01, 10000);
    FAIL();
  } catch (const pcl6d::BadArgument& e) {
    const std::string words = e.what();
    EXPECT_EQ(words.find("resolution = 0.01, but must be at least 0.7"), 0u) << words;
    EXPECT_NE(words.find("the map is 100 m x 50 m"), std::string::npos) << words;
  }
  const double least = extent.leastResolution(10000);
  EXPECT_LE(extent.raster(least, 10000).size(), 10000u);
  EXPECT_NEAR(least, std::sqrt(0.5), 0.03); // 5000 m2 in 10000 cells
}

TEST(MapRaster, APointHasOneCell)
{
  const MapExtent extent = extentOf({{2, 3, 0}}, {2, 3, 1});
  EXPECT_EQ(extent.raster(0.1, 1).size(), 1u);
  EXPECT_GT(extent.leastResolution(1), 0);
}

TEST(MapRaster, RefusesWhatBreaksItsRules)
{
  EXPECT_THROW(MapExtent().raster(1, 10), pcl6d::ComputeFailed);
  EXPECT_THROW(extentOf({}, {1, 2, 3}).raster(1, 10), pcl6d::ComputeFailed);
  for (const double edge : {0.0, -1.0, HUGE_VAL, std::nan("")})
    EXPECT_THROW(extentOf({{0, 0, 0}}, {0, 0, 0}).raster(edge, 10), pcl6d::BadArgument);
}
} // namespace
