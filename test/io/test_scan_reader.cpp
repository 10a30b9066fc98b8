// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_samples.h"

#include <pcl6d/io/scan_reader.h>

using pcl6d::Points;
using pcl6d::readScan;
using pcl6d::ScanFormat;
using pcl6d::test::bytesOf;
using pcl6d::test::expectIoFailed;
using pcl6d::test::TempFolder;
using pcl6d::test::valueOf;
using pcl6d::test::writeText;

TEST(ScanReader, FormatsHaveNames)
{
  EXPECT_EQ(pcl6d::scanFormatFromName("auto"), ScanFormat::kAuto);
  EXPECT_EQ(pcl6d::scanFormatFromName("pcd"), ScanFormat::kPcd);
  EXPECT_EQ(pcl6d::scanFormatFromName("ply"), ScanFormat::kPly);
  EXPECT_EQ(pcl6d::scanFormatFromName("uos"), ScanFormat::kUos);
  EXPECT_EQ(pcl6d::scanFormatFromName("uosr"), ScanFormat::kUosr);
  EXPECT_EQ(pcl6d::scanFormatFromName("kitti"), ScanFormat::kKitti);
  EXPECT_EQ(pcl6d::scanFormatFromName("xyz"), ScanFormat::kXyz);
  EXPECT_EQ(pcl6d::scanFormatFromName("las"), ScanFormat::kLas);
  EXPECT_EQ(pcl6d::scanFormatFromName("laz"), ScanFormat::kLaz);
  EXPECT_EQ(pcl6d::scanFormatFromName("pts"), ScanFormat::kPts);
  EXPECT_EQ(pcl6d::scanFormatFromName("csv"), ScanFormat::kCsv);
  EXPECT_EQ(pcl6d::scanFormatFromName("txt"), ScanFormat::kTxt);
  EXPECT_EQ(pcl6d::test::messageOf<pcl6d::BadArgument>(
                [] { pcl6d::scanFormatFromName("dxf"); }),
            "format = 'dxf', but must be auto, pcd, ply, uos, uosr, kitti, xyz, las, "
            "laz, ptx, pts, csv or txt");
}

TEST(ScanReader, TheFormatComesFromTheExtensionUnlessItIsGiven)
{
  const TempFolder folder;
  writeText(folder / "a.XYZ", "1 2 3\n");
  writeText(folder / "a.txt", "1 2 3\n");
  writeText(folder / "a.dxf", "1 2 3\n");
  EXPECT_EQ(readScan(folder / "a.XYZ").points, (Points{{1, 2, 3}}));
  EXPECT_EQ(readScan(folder / "a.txt", ScanFormat::kXyz).points, (Points{{1, 2, 3}}));
  EXPECT_EQ(readScan(folder / "a.txt", ScanFormat::kUos).points,
            (Points{{3 / 100.f, -1 / 100.f, 2 / 100.f}}));
  expectIoFailed(folder / "a.dxf",
                 "unknown format of scans '.dxf' (known: .pcd .ply .3d .bin .xyz .las "
                 ".laz .ptx .pts .csv .txt .asc)",
                 [&] { readScan(folder / "a.dxf"); });
}

TEST(ScanReader, PointsThatAreNotFiniteAreDroppedAndCounted)
{
  const TempFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  writeText(folder / "a.bin",
            bytesOf<float>({nan, 0, 0, 0, 1, 2, 3,    4, 0, inf, 0,  0,
                            5,   6, 7, 8, 0, 0, -inf, 0, 9, 10,  11, nan}));
  const auto scan = readScan(folder / "a.bin");
  EXPECT_EQ(scan.dropped, 3u);
  EXPECT_EQ(scan.points, (Points{{1, 2, 3}, {5, 6, 7}, {9, 10, 11}}));
  ASSERT_EQ(scan.cloud.width, 3u);
  EXPECT_EQ(scan.cloud.data.size(), 3u * 16);
  EXPECT_EQ(scan.cloud.row_step, 3u * 16);
  EXPECT_EQ(valueOf<float>(scan.cloud, 1, "z"), 7);
  EXPECT_EQ(valueOf<float>(scan.cloud, 1, "intensity"), 8); // goes with its point
  EXPECT_TRUE(std::isnan(valueOf<float>(scan.cloud, 2, "intensity")));
}

TEST(ScanReader, AnOrganizedScanStaysSoUnlessPointsAreDropped)
{
  const TempFolder folder;
  auto cloud = pcl6d::test::makeRichCloud(6);
  cloud.width = 2;
  cloud.height = 3;
  pcl6d::writePcd(folder / "a.pcd", cloud);
  auto scan = readScan(folder / "a.pcd"); // the z of point 1 is nan
  EXPECT_EQ(scan.dropped, 1u);
  EXPECT_EQ(scan.cloud.width, 5u);
  EXPECT_EQ(scan.cloud.height, 1u);
  const float z = 0;
  std::memcpy(&cloud.data[cloud.point_step + 8], &z, sizeof z);
  pcl6d::writePcd(folder / "a.pcd", cloud);
  scan = readScan(folder / "a.pcd");
  EXPECT_EQ(scan.dropped, 0u);
  EXPECT_EQ(scan.cloud.width, 2u);
  EXPECT_EQ(scan.cloud.height, 3u);
  EXPECT_TRUE(scan.cloud.is_dense);
}

TEST(ScanReader, DoubleCoordinatesBecomeFloatPointsAndStayInTheCloud)
{
  const TempFolder folder;
  writeText(folder / "a.pcd",
            "FIELDS x y z\nSIZE 8 4 8\nTYPE F F F\nWIDTH 2\nDATA ascii\n"
            "0.1 0.1 1e300\n0.1 0.2 0.3\n");
  const auto scan = readScan(folder / "a.pcd");
  EXPECT_EQ(scan.dropped, 1u); // 1e300 is not finite as a float
  EXPECT_EQ(scan.points, (Points{{0.1f, 0.2f, 0.3f}}));
  EXPECT_EQ(valueOf<double>(scan.cloud, 0, "x"), 0.1);
}

TEST(ScanReader, AScanWithoutPointsIsEmpty)
{
  const TempFolder folder;
  writeText(folder / "a.xyz", "# nothing\n");
  writeText(folder / "a.bin", "");
  pcl6d::writePcd(folder / "a.pcd", pcl6d::test::makeRichCloud(0));
  writeText(folder / "a.ply",
            "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\n"
            "property float y\nproperty float z\nend_header\n");
  for (const char* const name : {"a.xyz", "a.bin", "a.pcd", "a.ply"}) {
    const auto scan = readScan(folder / name);
    EXPECT_TRUE(scan.points.empty());
    EXPECT_EQ(scan.dropped, 0u);
    EXPECT_EQ(scan.cloud.height, 1u);
  }
}

TEST(ScanReader, FilesThatCannotBeReadAreNamedWithTheReason)
{
  const TempFolder folder;
  for (const char* const name :
       {"a.pcd", "a.ply", "a.3d", "a.bin", "a.xyz", "a.own", "a"}) {
    expectIoFailed(
        folder / name, "No such file or directory", [&] { readScan(folder / name); });
    std::filesystem::create_directory(folder / name);
    expectIoFailed(folder / name, "Is a directory", [&] { readScan(folder / name); });
  }
}
