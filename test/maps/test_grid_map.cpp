// SPDX-License-Identifier: BSD-3-Clause
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/maps/grid_map.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace {
using pcl6d::CellState;
using pcl6d::FloorHeights;
using pcl6d::GridMap;
using pcl6d::GridMapOptions;
using pcl6d::MappedScan;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;

/** \return heights from 0.2 m to 2 m */
GridMapOptions
lowAndHigh(double from = 0.2, double to = 2)
{
  GridMapOptions options;
  options.from = from;
  options.to = to;
  return options;
}

/** A scanner 1 m above the floor z = 0 in the middle of the cell 0 0; a wall at x = 4, a point of
 * the floor at y = 5, and one of a ceiling at x = -5. */
MappedScan
sceneOfGrid()
{
  MappedScan scan;
  scan.origin = {0.5F, 0.5F, 1};
  scan.points = {{4.5F, 0.5F, 1}, {0.5F, 5.5F, 0}, {-4.5F, 0.5F, 5}};
  return scan;
}

pcl6d::MapRaster
rasterOf(const MappedScan& scan)
{
  pcl6d::MapExtent extent;
  extent.add(scan);
  return extent.raster(1, 1000);
}

/** \return the map as text: '.' free, '#' occupied, '?' unknown; the largest y first */
std::string
drawn(const GridMap& map)
{
  std::string text;
  for (std::size_t row = map.raster().rows; row-- > 0;) {
    for (std::size_t column = 0; column < map.raster().columns; ++column)
      text += "?.#"[static_cast<int>(map.state(row * map.raster().columns + column))];
    text += '\n';
  }
  return text;
}

TEST(GridMap, CellsAreFreeWhereRaysPassAtTheHeights)
{
  const MappedScan scan = sceneOfGrid();
  GridMap map(rasterOf(scan), FloorHeights(0), lowAndHigh());
  map.insert(scan);
  // The ray to the floor is below 0.2 m from y = 4.5 on: in the cell 4 it still passes. The ray
  // to the ceiling is above 2 m from x = -0.75 on.
  EXPECT_EQ(drawn(map),
            "??????????\n"
            "?????.????\n"
            "?????.????\n"
            "?????.????\n"
            "?????.????\n"
            "????.....#\n");
  EXPECT_EQ(map.count(CellState::kFree), 9u);
  EXPECT_EQ(map.count(CellState::kOccupied), 1u);
  EXPECT_EQ(map.count(CellState::kUnknown), 50u);
}

TEST(GridMap, OtherHeightsAreOtherObstacles)
{
  const MappedScan scan = sceneOfGrid();
  GridMap map(rasterOf(scan), FloorHeights(0), lowAndHigh(4, 6));
  map.insert(scan); // only the ceiling: 4 m are reached at x = -3.25
  EXPECT_EQ(drawn(map).substr(55), "#.????????\n");
  GridMap above(rasterOf(scan), FloorHeights(-3), lowAndHigh(4, 6));
  above.insert(scan); // the same above a floor at -3: 1 to 3 m, up to x = -2
  EXPECT_EQ(drawn(above).substr(55), "???......#\n");
}

TEST(GridMap, OccupiedPrevailsWhateverPassesLater)
{
  MappedScan scan = sceneOfGrid();
  GridMap map(rasterOf(scan), FloorHeights(0), lowAndHigh());
  MappedScan near = scan;
  near.points = {{2.5F, 0.5F, 0.5F}};
  map.insert(near);
  for (int i = 0; i < 3; ++i)
    map.insert(scan);
  EXPECT_EQ(drawn(map).substr(55), "????...#.#\n");
}

TEST(GridMap, WithoutRaysNothingIsFree)
{
  MappedScan scan = sceneOfGrid();
  scan.has_rays = false;
  GridMap map(rasterOf(scan), FloorHeights(0), lowAndHigh());
  map.insert(scan);
  EXPECT_EQ(map.count(CellState::kFree), 0u);
  EXPECT_EQ(map.count(CellState::kOccupied), 1u);
}

TEST(GridMap, RaysEndAtTheLargestRangeWithoutAHit)
{
  const MappedScan scan = sceneOfGrid();
  GridMapOptions options = lowAndHigh();
  options.max_range = 2.2; // x = 2.7; y = 2.66 as the ray slants; x = -1.22 at z = 2.37
  GridMap map(rasterOf(scan), FloorHeights(0), options);
  map.insert(scan);
  EXPECT_EQ(drawn(map),
            "??????????\n"
            "??????????\n"
            "??????????\n"
            "?????.????\n"
            "?????.????\n"
            "????....??\n");
}

TEST(GridMap, ASlantedRayGoesThroughTheCellsOfItsLine)
{
  MappedScan scan;
  scan.origin = {0.5F, 0.5F, 1};
  scan.points = {{4.5F, 2.5F, 1}, {4.5F, -1.5F, 1}}; // y changes at x = 1.5 and 3.5
  GridMap map(rasterOf(scan), FloorHeights(0), lowAndHigh());
  map.insert(scan);
  EXPECT_EQ(drawn(map),
            "???.#\n"
            "?...?\n"
            "..???\n"
            "?...?\n"
            "???.#\n");
}

TEST(GridMap, ItsFilesAreThoseOfMapServer)
{
  const TempFolder folder;
  const MappedScan scan = sceneOfGrid();
  GridMap map(rasterOf(scan), FloorHeights(0), lowAndHigh());
  map.insert(scan);
  map.write(folder / "office.yaml");
  EXPECT_EQ(
      readText(folder / "office.yaml"),
      "image: \"office.pgm\"\nmode: trinary\nresolution: 1\norigin: [-5, 0, 0.0]\n"
      "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const std::string image = readText(folder / "office.pgm");
  const std::string head = "P5\n10 6\n255\n";
  ASSERT_EQ(image.size(), head.size() + 60);
  EXPECT_EQ(image.substr(0, head.size()), head);
  std::string expected = drawn(map);
  expected.erase(std::remove(expected.begin(), expected.end(), '\n'), expected.end());
  for (std::size_t i = 0; i < 60; ++i) {
    const int shade = static_cast<unsigned char>(image[head.size() + i]);
    EXPECT_EQ(shade, expected[i] == '.' ? 254 : expected[i] == '#' ? 0 : 205) << i;
    // As map_server takes them: above 0.65 occupied, below 0.196 free.
    const double occupancy = (255 - shade) / 255.0;
    EXPECT_EQ(occupancy > 0.65, expected[i] == '#');
    EXPECT_EQ(occupancy < 0.196, expected[i] == '.');
  }
  EXPECT_THROW(map.write(folder / "office.png"), pcl6d::BadArgument);
}

TEST(GridMap, RefusesWhatBreaksItsRules)
{
  const pcl6d::MapRaster raster = rasterOf(sceneOfGrid());
  const double infinite = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] :
       {std::pair(1.0, 1.0), {2.0, 1.0}, {0.0, infinite}, {NAN, 1.0}})
    EXPECT_THROW(GridMap(raster, FloorHeights(0), lowAndHigh(from, to)),
                 pcl6d::BadArgument);
  GridMapOptions options;
  options.max_range = 0;
  EXPECT_THROW(GridMap(raster, FloorHeights(0), options), pcl6d::BadArgument);
}
} // namespace
