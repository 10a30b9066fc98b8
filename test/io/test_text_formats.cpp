// SPDX-License-Identifier: BSD-3-Clause
#include "io_test.h"

#include <pcl6d/io/scan_reader.h>

using pcl6d::Points;
using pcl6d::readScan;
using pcl6d::test::expectIoFailed;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

TEST(Uos, LeftHandedCentimetresBecomeRightHandedMetres)
{
  const TempFolder folder;
  // 1 cm right, 2 cm up, 3 cm forward; further columns are not ours.
  writeText(folder / "scan000.3d", "1 2 3\n\n-100 0 250.5 0.7 12\r\n");
  const auto scan = readScan(folder / "scan000.3d");
  EXPECT_EQ(scan.points,
            (Points{{3 / 100.f, -1 / 100.f, 2 / 100.f}, {250.5f / 100.f, 1, 0}}));
  EXPECT_EQ(pcl6d::test::valueOf<float>(scan.cloud, 1, "x"), 250.5f / 100.f);
}

TEST(Uos, CentimetresAreDividedBeforeTheyAreRounded)
{
  const TempFolder folder;
  // In float, 72 of the 200 quotients miss the nearest float.
  std::string content;
  Points expected;
  for (int i = 0; i < 200; ++i) {
    content += "0 0 " + std::to_string(i) + ".37\n";
    expected.push_back({static_cast<float>((i + 0.37) / 100), 0, 0});
  }
  writeText(folder / "scan000.3d", content);
  EXPECT_EQ(readScan(folder / "scan000.3d").points, expected);
}

TEST(Uosr, TheFourthColumnIsTheIntensity)
{
  const TempFolder folder;
  writeText(folder / "scan000.3d", "points 2\n1 2 3 0.5\n4 5 6 +7e1\n");
  const auto scan = readScan(folder / "scan000.3d", pcl6d::ScanFormat::kUosr);
  ASSERT_EQ(scan.points.size(), 2u);
  EXPECT_EQ(scan.points[0], Eigen::Vector3f(3 / 100.f, -1 / 100.f, 2 / 100.f));
  EXPECT_EQ(pcl6d::test::valueOf<float>(scan.cloud, 0, "intensity"), 0.5f);
  EXPECT_EQ(pcl6d::test::valueOf<float>(scan.cloud, 1, "intensity"), 70);
  EXPECT_TRUE(scan.left_out.empty());
  writeText(folder / "scan000.3d", "1 2 3 4\n1 2 3\n");
  expectIoFailed(folder / "scan000.3d",
                 "line 2: expected at least 4 numbers, got 3",
                 [&] { readScan(folder / "scan000.3d", pcl6d::ScanFormat::kUosr); });
}

TEST(TextFormats, ColumnsThatAreNotReadAreTold)
{
  const TempFolder folder;
  writeText(folder / "scan.xyz", "1 2 3 \t\n4;5;6;\n1,2,3,4\n1 2 3 4\n");
  EXPECT_EQ(readScan(folder / "scan.xyz").left_out,
            (std::vector<std::string>{"columns behind the first 3 (line 3)"}));
  writeText(folder / "scan.xyz", "1 2 3 \t\n4;5;6;\n");
  EXPECT_TRUE(readScan(folder / "scan.xyz").left_out.empty());
}

TEST(TextFormats, FilesOfAnySizeAreReadBlockByBlock)
{
  const TempFolder folder;
  std::string content;
  for (int i = 0; i < 100000; ++i) // lines of all lengths about the ends of blocks
    content += std::to_string(i) + ".5 0 " + std::string(i % 5, ' ') + "-1e0\r\n";
  content += std::string(1 << 19, ' ') + "7 8 9"; // longer than a block, without end
  writeText(folder / "scan.xyz", content);
  const auto points = readScan(folder / "scan.xyz").points;
  ASSERT_EQ(points.size(), 100001u);
  for (int i = 0; i < 100000; ++i)
    ASSERT_EQ(points[static_cast<std::size_t>(i)],
              Eigen::Vector3f(static_cast<float>(i) + 0.5f, 0, -1));
  EXPECT_EQ(points.back(), Eigen::Vector3f(7, 8, 9));
}

TEST(Uos, OnlyTheFirstLineMayBeAHeading)
{
  const TempFolder folder;
  writeText(folder / "scan000.3d", "points: 2 x 1\n1 2 3\n");
  EXPECT_EQ(readScan(folder / "scan000.3d").points.size(), 1u);
  writeText(folder / "scan000.3d", "1 2 3\npoints: 2 x 1\n");
  expectIoFailed(folder / "scan000.3d", "line 2: 'points:' is not a number", [&] {
    readScan(folder / "scan000.3d");
  });
}

TEST(Uos, SizesOfTheScanAreHeadings)
{
  const TempFolder folder;
  for (const std::string heading :
       {"180 x 60", "180 X 60", "181 256", "2", "180x60", "uos 2"}) {
    SCOPED_TRACE(heading);
    writeText(folder / "scan000.3d", heading + "\n1 2 3\n4 5 6\n");
    EXPECT_EQ(readScan(folder / "scan000.3d").points.size(), 2u);
    writeText(folder / "scan000.3d", "1 2 3\n" + heading + "\n");
    EXPECT_THROW(readScan(folder / "scan000.3d"), pcl6d::IoFailed);
  }
  for (const std::string row : {"180 y 60", "180 x 60.5", "1.5 2", "-1 2"}) {
    SCOPED_TRACE(row);
    writeText(folder / "scan000.3d", row + "\n1 2 3\n");
    EXPECT_THROW(readScan(folder / "scan000.3d"), pcl6d::IoFailed);
  }
}

TEST(Uos, BrokenLinesAreNamed)
{
  const TempFolder folder;
  const auto path = folder / "scan000.3d";
  writeText(path, "1 2 3\n4 5\n");
  expectIoFailed(
      path, "line 2: expected at least 3 numbers, got 2", [&] { readScan(path); });
  writeText(path, "1 2 3\n\n4 5 6x\n");
  expectIoFailed(path, "line 3: '6x' is not a number", [&] { readScan(path); });
  writeText(path, "1 2.5\n");
  expectIoFailed(
      path, "line 1: expected at least 3 numbers, got 2", [&] { readScan(path); });
}

TEST(Xyz, TakesUsualSeparatorsAndComments)
{
  const TempFolder folder;
  writeText(folder / "scan.xyz",
            "# x y z\n1 2 3\n\n4,5,6\n  7;8;9;255\n1.5,\t-2.5 ; +3e-1 x\n");
  EXPECT_EQ(readScan(folder / "scan.xyz").points,
            (Points{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {1.5f, -2.5f, 0.3f}}));
}

TEST(Xyz, BrokenLinesAreNamed)
{
  const TempFolder folder;
  const auto path = folder / "scan.xyz";
  writeText(path, "1 2 3\nx y z\n");
  expectIoFailed(path, "line 2: 'x' is not a number", [&] { readScan(path); });
  writeText(path, "1 2 3\n4;5\n");
  expectIoFailed(
      path, "line 2: expected at least 3 numbers, got 2", [&] { readScan(path); });
  writeText(path, std::string("1 2 3\n4 \0\x01 5\n", 13));
  expectIoFailed(path,
                 "line 2: '?"
                 "?' is not a number",
                 [&] { readScan(path); });
  writeText(path, "1 2 " + std::string(1000, 'y'));
  expectIoFailed(path,
                 "line 1: '" + std::string(40, 'y') + "...' is not a number",
                 [&] { readScan(path); });
}

TEST(TextFormats, ADecimalCommaElsewhereChangesNothing)
{
  const TempFolder folder;
  writeText(folder / "scan.xyz", "1.5 2.5 3.5\n");
  writeText(folder / "scan.3d", "150 250 350\n");
  const pcl6d::test::DecimalComma locale;
  EXPECT_EQ(readScan(folder / "scan.xyz").points, (Points{{1.5f, 2.5f, 3.5f}}));
  EXPECT_EQ(readScan(folder / "scan.3d").points, (Points{{3.5f, -1.5f, 2.5f}}));
}

TEST(Kitti, PointsAndIntensityAreTakenAsTheyAre)
{
  const TempFolder folder;
  writeText(folder / "000000.bin",
            pcl6d::test::bytesOf<float>({1, 2, 3, 0.5, 4, 5, 6, 0.25}));
  const auto scan = readScan(folder / "000000.bin");
  EXPECT_EQ(scan.points, (Points{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(pcl6d::test::valueOf<float>(scan.cloud, 1, "intensity"), 0.25f);
}

TEST(Kitti, ASizeThatIsNoMultipleOf16IsRefused)
{
  const TempFolder folder;
  const auto path = folder / "000000.bin";
  const std::string content = pcl6d::test::bytesOf<float>({1, 2, 3, 4, 5, 6, 7, 8});
  for (std::size_t size = 0; size <= content.size(); ++size) {
    writeText(path, content.substr(0, size));
    if (size % 16 == 0)
      EXPECT_EQ(readScan(path).points.size(), size / 16);
    else
      expectIoFailed(path,
                     "its size of " + std::to_string(size) +
                         (size == 1 ? " byte" : " bytes") +
                         " is not a multiple of 16 (float32 x y z intensity)",
                     [&] { readScan(path); });
  }
}
