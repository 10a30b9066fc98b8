// SPDX-License-Identifier: BSD-3-Clause
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/maps/height_map.h>
#include <pcl6d/sources/coordinate_system.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace {
using pcl6d::HeightMap;
using pcl6d::MappedScan;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;

/** Three points in the cell at x = 0, y = 0, and one at x = 2, y = 1; cells of 1 m. */
HeightMap
someHeights()
{
  MappedScan scan;
  scan.origin = {0.5F, 0.5F, 0};
  scan.points = {{0.2F, 0.5F, 1}, {0.5F, 0.5F, 4}, {0.5F, 0.9F, -2}, {2.5F, 1.5F, 7}};
  pcl6d::MapExtent extent;
  extent.add(scan);
  HeightMap map(extent.raster(1, 100));
  map.insert(scan);
  return map;
}

/** \return what a command prints */
std::string
printed(const TempFolder& folder, const std::string& command)
{
  const std::string file = folder / "printed";
  EXPECT_EQ(std::system(("cd '" + folder.path().string() + "' && " + command + " > '" +
                         file + "' 2>&1")
                            .c_str()),
            0)
      << readText(file);
  return readText(file);
}

void
expectText(const std::string& text, const std::string& part)
{
  EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
}

TEST(HeightMap, CellsHaveLowestHighestAndMean)
{
  const HeightMap map = someHeights();
  ASSERT_EQ(map.raster().columns, 3u);
  ASSERT_EQ(map.raster().rows, 2u);
  const HeightMap::Cell& cell = map.cell(0);
  EXPECT_EQ(cell.points, 3u);
  EXPECT_EQ(cell.lowest, -2);
  EXPECT_EQ(cell.highest, 4);
  EXPECT_EQ(cell.sum, 3);
  EXPECT_EQ(map.cell(1).points, 0u);
  EXPECT_EQ(map.cell(5).sum, 7);
}

TEST(HeightMap, GdalReadsItsGeoTiff)
{
  if (std::system("command -v gdalinfo gdal_translate > /dev/null") != 0)
    GTEST_SKIP() << "no gdalinfo: apt-get install gdal-bin";
  if (!pcl6d::canWriteGeoTiff())
    GTEST_SKIP() << "built without GDAL: apt-get install libgdal-dev";
  const TempFolder folder;
  writeGeoTiff(folder / "dem.tif",
               someHeights(),
               {432000, 5512000, 100},
               pcl6d::wktOfEpsg(25832));
  const std::string info = printed(folder, "gdalinfo dem.tif");
  expectText(info, "Driver: GTiff/GeoTIFF");
  expectText(info, "Size is 3, 2");
  expectText(info, "Origin = (432000.000000000000000,5512002.000000000000000)");
  expectText(info, "Pixel Size = (1.000000000000000,-1.000000000000000)");
  expectText(info, "ID[\"EPSG\",25832]]");
  for (const std::string band : {"lowest", "highest", "mean"})
    expectText(info, "Description = " + band);
  expectText(info, "NoData Value=nan");
  // The values, by an independent reader: x y value, the largest y first.
  const auto valuesOf = [&](const std::string& band) {
    printed(folder, "gdal_translate -q -of XYZ -b " + band + " dem.tif values.xyz");
    return readText(folder / "values.xyz");
  };
  const std::string at = "432000.5 5512001.5 nan\n432001.5 5512001.5 nan\n"
                         "432002.5 5512001.5 107\n432000.5 5512000.5 ";
  const std::string end = "\n432001.5 5512000.5 nan\n432002.5 5512000.5 nan\n";
  EXPECT_EQ(valuesOf("1"), at + "98" + end);
  EXPECT_EQ(valuesOf("2"), at + "104" + end);
  EXPECT_EQ(valuesOf("3"), at + "101" + end);
}

TEST(HeightMap, AFileThatCannotBeWrittenIsAnError)
{
  if (!pcl6d::canWriteGeoTiff())
    GTEST_SKIP() << "built without GDAL: apt-get install libgdal-dev";
  const TempFolder folder;
  EXPECT_THROW(writeGeoTiff(folder / "none" / "dem.tif", someHeights(), {0, 0, 0}),
               pcl6d::IoFailed);
  EXPECT_THROW(writeGeoTiff(folder / "dem.tif", someHeights(), {0, 0, 0}, "no system"),
               pcl6d::IoFailed);
  EXPECT_FALSE(std::filesystem::exists(folder / "dem.tif"));
}
} // namespace
