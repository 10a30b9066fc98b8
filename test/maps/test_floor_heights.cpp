// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/maps/floor_heights.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace {
using pcl6d::FloorHeights;
using pcl6d::FloorLayers;
using pcl6d::MapExtent;
using pcl6d::MappedScan;
using pcl6d::Points;

/** [m] by which the middle of a layer differs from a surface at most. */
constexpr double kHalfLayer = FloorLayers::kLayer / 2;
/** [m] of the floor below a scanner, a mean over 100 cells of which two have a foot of a wall. */
constexpr double kVoted = 2 * kHalfLayer / 100;

/** \return a point each 10 cm of 10 m x 10 m, at the heights of a function; NaN: none */
Points
groundOf(const std::function<double(double, double)>& height)
{
  Points points;
  for (int i = -50; i < 50; ++i)
    for (int j = -50; j < 50; ++j) {
      const double x = 0.1 * i + 0.05, y = 0.1 * j + 0.05, z = height(x, y);
      if (!std::isnan(z))
        points.emplace_back(
            static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
    }
  return points;
}

/** \return the floor of a scan from 1.2 m above the middle */
FloorHeights
floorOf(const Points& points,
        const Eigen::Vector3f& origin = {0.05F, 0.05F, 1.2F},
        std::size_t most_cells = 1000000)
{
  MappedScan scan;
  scan.points = points;
  scan.origin = origin;
  FloorLayers layers;
  layers.add(scan);
  MapExtent extent;
  extent.add(scan);
  return FloorHeights(layers, extent, most_cells);
}

TEST(FloorHeights, ALevelFloorWithAWall)
{
  Points points = groundOf([](double, double) { return -1.5; });
  for (int i = 0; i < 100; ++i) // at x = 3
    for (int j = 0; j < 25; ++j)
      points.emplace_back(3.F, 0.1F * static_cast<float>(i) - 4.95F, 0.1F * j - 1.45F);
  const FloorHeights floor = floorOf(points);
  EXPECT_TRUE(floor.isKnown());
  for (const double x : {-4.9, 0.0, 4.9})
    EXPECT_NEAR(floor.at(x, x), -1.5, kVoted);
  EXPECT_NEAR(floor.at(3, 3), -1.5, kHalfLayer); // the foot of the wall is in the layer
  EXPECT_NEAR(medianHeight({{0, 0, 0}, {1, 0, 2}, {0, 1, -1}}, floor), 1.5, kVoted);
}

TEST(FloorHeights, ARampIsFloor)
{
  const double slope = 0.2;
  const FloorHeights floor =
      floorOf(groundOf([&](double x, double) { return slope * x; }));
  // A cell of the ramp lies in two layers or three.
  for (const double x : {-4.0, -1.3, 0.0, 2.6, 4.0})
    EXPECT_NEAR(floor.at(x, 1), slope * x, 2 * kHalfLayer) << x;
}

TEST(FloorHeights, TablesAndRoofsStandOnTheFloor)
{
  // Two metres wide, without points below; a roof behind a gap.
  const FloorHeights floor = floorOf(groundOf([](double x, double y) {
    return std::abs(x - 2) < 1 && std::abs(y) < 1 ? 0.8 : x < -4 ? 3.0 : 0.0;
  }));
  for (const double x : {-4.8, -3.0, 0.0, 2.0, 2.9, 4.5})
    EXPECT_NEAR(floor.at(x, 0), 0, 1e-6) << x;
}

TEST(FloorHeights, WhatIsMirroredBelowTheFloorIsNotReached)
{
  Points points = groundOf([](double, double) { return 0; });
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j) // nine square metres
      points.emplace_back(1 + 0.1F * i, 1 + 0.1F * j, -0.6F - 0.1F * i);
  const FloorHeights floor = floorOf(points);
  for (const double x : {-2.0, 0.0, 1.1, 2.5, 4.5})
    EXPECT_NEAR(floor.at(x, x), 0, 1e-6) << x;
}

TEST(FloorHeights, TheFloorIsFoundAgainBehindAGap)
{
  // 6 m without points, 0.5 m higher behind.
  const FloorHeights floor = floorOf(groundOf([](double x, double) {
                                       return x < -1 ? 0.0 : x < 3 ? NAN : 0.5;
                                     }),
                                     {-3, 0, 1});
  EXPECT_NEAR(floor.at(-2, 0), 0, 1e-6);
  EXPECT_NEAR(floor.at(1, 0), 0, 1e-6);
  EXPECT_NEAR(floor.at(4, 0), 0.5, 1e-6);
}

TEST(FloorHeights, WithoutAFloorHeightsCountFromTheLowestScanner)
{
  const FloorHeights floor = floorOf({{3, 0, 0.7F}, {0, 3, 0.7F}}, {0, 0, 0.7F});
  EXPECT_FALSE(floor.isKnown());
  EXPECT_NEAR(floor.at(1, 1), 0.7, 1e-6);
}

TEST(FloorHeights, TooLargeMapsAndEmptyOnesAreRefused)
{
  EXPECT_THROW(floorOf({}), pcl6d::ComputeFailed);
  EXPECT_THROW(floorOf({{0, 0, 0}, {9000, 9000, 0}}, {0, 0, 1}, 1000),
               pcl6d::ComputeFailed);
  EXPECT_EQ(FloorHeights(2.5).at(1e6, -3), 2.5);
}
} // namespace
