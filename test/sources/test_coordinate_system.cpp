// SPDX-License-Identifier: BSD-3-Clause
// Coordinate systems by their codes, in LAS, LAZ and E57 files.
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_writer.h>
#include <pcl6d/sources/coordinate_system.h>
#include <pcl6d/sources/e57_writer.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <gtest/gtest.h>

#include <string>

namespace {
namespace fs = std::filesystem;
using pcl6d::BadArgument;
using pcl6d::coordinateSystemOf;
using pcl6d::nameOfWkt;
using pcl6d::wktOfEpsg;
using pcl6d::test::TempFolder;

pcl::PCLPointCloud2
points()
{
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (int i = 0; i < 300; ++i) {
    pcl::PointXYZI p;
    p.x = static_cast<float>(0.01 * i);
    p.y = static_cast<float>(1 + 0.02 * (i % 17));
    p.z = static_cast<float>(0.5 * (i % 3));
    p.intensity = static_cast<float>(i % 256);
    cloud.push_back(p);
  }
  pcl::PCLPointCloud2 blob;
  pcl::toPCLPointCloud2(cloud, blob);
  return blob;
}

std::string
messageOfCode(int code)
{
  try {
    wktOfEpsg(code);
  } catch (const BadArgument& e) {
    return e.what();
  }
  return "";
}
} // namespace

TEST(CoordinateSystem, CodesOfProjectedSystemsHaveText)
{
  EXPECT_EQ(nameOfWkt(wktOfEpsg(25832)), "ETRS89 / UTM zone 32N");
  EXPECT_EQ(wktOfEpsg(25832).rfind("PROJCS[", 0), 0u);
  EXPECT_NE(wktOfEpsg(25832).find("\"25832\""), std::string::npos);
  EXPECT_EQ(nameOfWkt(wktOfEpsg(7405)), "OSGB36 / British National Grid + ODN height")
      << "with heights";
  EXPECT_EQ(nameOfWkt("no text"), "no text");
}

TEST(CoordinateSystem, OtherCodesAreRefusedByName)
{
  EXPECT_NE(messageOfCode(1).find("epsg = 1, but must be a coordinate system"),
            std::string::npos)
      << messageOfCode(1);
  EXPECT_NE(messageOfCode(-4).find("epsg = -4"), std::string::npos);
  EXPECT_NE(messageOfCode(4326).find("a projected system, but is WGS 84"),
            std::string::npos)
      << messageOfCode(4326);
  EXPECT_NE(
      messageOfCode(2263).find("in metres, which NAD83 / New York Long Island (ftUS)"),
      std::string::npos)
      << messageOfCode(2263);
}

TEST(CoordinateSystem, IsWrittenToLasAndLazAndReadBack)
{
  const TempFolder folder;
  pcl6d::ScanWriterOptions options;
  options.coordinate_system = wktOfEpsg(25832);
  for (const std::string name : {"a.las", "a.laz"}) {
    const fs::path with = folder / name, without = folder / ("plain_" + name);
    pcl6d::writeScan(with, points(), Eigen::Isometry3d::Identity(), options);
    pcl6d::writeScan(without, points());
    EXPECT_EQ(coordinateSystemOf(with), options.coordinate_system) << name;
    EXPECT_EQ(coordinateSystemOf(without), "") << name;
    const auto a = pcl6d::readScanCloud(with), b = pcl6d::readScanCloud(without);
    EXPECT_EQ(a.cloud.data, b.cloud.data) << name;
    EXPECT_EQ(a.cloud.width, 300u);
  }
  options.coordinate_system.assign(70000, 'x');
  EXPECT_THROW(pcl6d::writeScan(
                   folder / "b.las", points(), Eigen::Isometry3d::Identity(), options),
               BadArgument);
}

TEST(CoordinateSystem, IsWrittenToE57AndReadBack)
{
  const TempFolder folder;
  const auto station = [](std::size_t) {
    pcl6d::E57Station one;
    one.name = "Lobby";
    one.scan.cloud = points();
    return one;
  };
  const std::string strange = wktOfEpsg(25832) + " <&>";
  pcl6d::writeE57(folder / "with.e57", 1, station, strange);
  pcl6d::writeE57(folder / "without.e57", 1, station);
  EXPECT_EQ(coordinateSystemOf(folder / "with.e57"), strange);
  EXPECT_EQ(coordinateSystemOf(folder / "without.e57"), "");
}

TEST(CoordinateSystem, OtherFilesNameNone)
{
  const TempFolder folder;
  pcl6d::writeScan(folder / "a.pcd", points());
  EXPECT_EQ(coordinateSystemOf(folder / "a.pcd"), "");
  EXPECT_THROW(coordinateSystemOf(folder / "none.las"), pcl6d::IoFailed);
}
