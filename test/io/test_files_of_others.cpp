// SPDX-License-Identifier: BSD-3-Clause
// Variations that other programs write of PCD, PLY and rows of poses.
#include "io_test.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/trajectory_formats.h>
#include <pcl6d/io/trajectory_io.h>

using pcl6d::Points;
using pcl6d::readScan;
using pcl6d::readTrajectory;
using pcl6d::test::expectIoFailed;
using pcl6d::test::TempFolder;
using pcl6d::test::valueOf;
using pcl6d::test::writeText;

namespace {

std::string
pcdWith(const std::string& viewpoint, const std::string& rows)
{
  return "VERSION 0.7\nFIELDS x y z label\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n"
         "WIDTH 2\nHEIGHT 1\nVIEWPOINT " +
         viewpoint + "\nPOINTS 2\nDATA ascii\n" + rows;
}

class OfOthers : public testing::Test {
protected:
  /** \return the trajectory of these rows */
  pcl6d::Trajectory
  read(const std::string& rows)
  {
    writeText(file_, rows);
    return readTrajectory(file_);
  }
  TempFolder folder_;
  const std::filesystem::path file_ = folder_ / "poses.txt";
};

const std::string kQuarter =
    "0 0 0.70710678118654752 0.70710678118654752"; // about z, w last

/** \return the motion of the rows below: 1 2 3, a quarter of a turn about z */
Eigen::Isometry3d
expectedPose()
{
  Eigen::Isometry3d pose = pcl6d::planarPose(1, 2, M_PI / 2);
  pose.translation().z() = 3;
  return pose;
}
} // namespace

TEST(PcdOfOthers, AViewpointOfZerosIsNone)
{
  const TempFolder folder;
  writeText(folder / "a.pcd", pcdWith("0 0 0 0 0 0 0", "1 2 3 4\n5 6 7 8\n"));
  EXPECT_EQ(pcl6d::readPcdViewpoint(folder / "a.pcd").matrix(),
            Eigen::Matrix4d::Identity());
  writeText(folder / "a.pcd", pcdWith("1 0 0 0 0 0 0", "1 2 3 4\n5 6 7 8\n"));
  EXPECT_THROW(pcl6d::readPcdViewpoint(folder / "a.pcd"), pcl6d::IoFailed);
}

TEST(PcdOfOthers, WholeNumbersMayBeWrittenAsFloatingPoint)
{
  const TempFolder folder;
  const auto path = folder / "a.pcd";
  writeText(path, pcdWith("0 0 0 1 0 0 0", "1 2 3 12.0\n5 6 7 4.29e9\n"));
  const auto scan = readScan(path);
  EXPECT_EQ(valueOf<std::uint32_t>(scan.cloud, 0, "label"), 12U);
  EXPECT_EQ(valueOf<std::uint32_t>(scan.cloud, 1, "label"), 4290000000U);
  for (const std::string wrong : {"12.5", "4.3e9", "-1.0", "nan", "inf"}) {
    writeText(path, pcdWith("0 0 0 1 0 0 0", "1 2 3 4\n5 6 7 " + wrong + "\n"));
    expectIoFailed(path,
                   "line 12: '" + wrong +
                       "' is not a number that field 'label' can hold",
                   [&] { readScan(path); });
  }
}

TEST(PlyOfOthers, APropertyMayHaveALineOfItsOwn)
{
  const TempFolder folder;
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
      "property float z\nend_header\n";
  writeText(folder / "a.ply", header + "1\n2\n3\n\n4\n5\n6\n");
  EXPECT_EQ(readScan(folder / "a.ply").points, (Points{{1, 2, 3}, {4, 5, 6}}));
  writeText(folder / "a.ply", header + "1\n2\n3\n4\n5\n");
  EXPECT_THROW(readScan(folder / "a.ply"), pcl6d::IoFailed);
  writeText(folder / "a.ply", header + "1\n2\n3\n4\n5\n6\n7\n");
  EXPECT_THROW(readScan(folder / "a.ply"), pcl6d::IoFailed);
  writeText(folder / "a.ply",
            header + "1 2\n3\n4 5 6\n"); // rows that are broken stay so
  expectIoFailed(folder / "a.ply", "line 8: vertex 1 of 2 has no z", [&] {
    readScan(folder / "a.ply");
  });
}

TEST(PlyOfOthers, CapitalsAndWholeCoordinatesAreRead)
{
  const TempFolder folder;
  for (const std::string type : {"int", "short", "uchar", "float", "double"}) {
    SCOPED_TRACE(type);
    writeText(folder / "a.ply",
              "ply\nformat ascii 1.0\nelement vertex 2\nproperty " + type +
                  " X\nproperty " + type + " Y\nproperty " + type +
                  " Z\nproperty float Intensity\nend_header\n1 2 3 0.5\n4 5 6 0.25\n");
    const auto scan = readScan(folder / "a.ply");
    EXPECT_EQ(scan.points, (Points{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(valueOf<float>(scan.cloud, 1, "intensity"), 0.25f);
  }
  const std::string binary =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty "
      "int x\nproperty int y\nproperty int z\nend_header\n";
  writeText(folder / "a.ply", binary + pcl6d::test::bytesOf<std::int32_t>({-7, 8, 9}));
  EXPECT_EQ(readScan(folder / "a.ply").points, (Points{{-7, 8, 9}}));
}

TEST(PcdOfOthers, CapitalsAndTabsAreRead)
{
  const TempFolder folder;
  writeText(folder / "a.pcd",
            "VERSION 0.7\nFIELDS X Y Z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\n"
            "HEIGHT 1\nPOINTS 2\nDATA ascii\n289814.15\t4320978.61\t170.76\n"
            "289814.64\t4320978.84\t170.75\n");
  const auto scan = readScan(folder / "a.pcd");
  ASSERT_EQ(scan.points.size(), 2U);
  EXPECT_EQ(scan.cloud.fields[0].name, "x");
  writeText(folder / "a.pcd", // there is an x already
            "VERSION 0.7\nFIELDS x y z X\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 "
            "1\nWIDTH 1\n"
            "HEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3 4\n");
  const auto both = readScan(folder / "a.pcd");
  EXPECT_EQ(both.points, (Points{{1, 2, 3}}));
  EXPECT_EQ(both.cloud.fields[3].name, "X");
}

TEST_F(OfOthers, RowsOfEveryKindGiveTheSamePose)
{
  const std::string matrix = "0 -1 0 1 1 0 0 2 0 0 1 3";
  const std::string euroc = "0.70710678118654752,0,0,0.70710678118654752"; // w first
  for (const std::string& row :
       {matrix,
        matrix + " 0 0 0 1",
        "7 " + matrix,
        "7 " + matrix + " 0 0 0 1",
        "7 1 2 3 " + kQuarter,
        "7 1 2 3 " + kQuarter + " 42",
        std::string("7,1,2,3,0,0,0.70710678118654752,0.70710678118654752"),
        "#timestamp, p_x, p_y, p_z, q_RS_w [], q_RS_x []\n7,1,2,3," + euroc,
        "stamp,x,y,z,qw,qx,qy,qz\n7,1,2,3," + euroc,
        "1403636580838555648,1,2,3," + euroc,
        "1403636580838555648,1,2,3," + euroc + ",0.1,0.2,0.3,0,0,0,0.1,0.2,0.3"}) {
    SCOPED_TRACE(row);
    const auto trajectory = read(row + "\n");
    ASSERT_EQ(trajectory.poses.size(), 1U);
    EXPECT_TRUE(trajectory.poses[0].isApprox(expectedPose(), 1e-12));
  }
}

TEST_F(OfOthers, NanosecondsBecomeSeconds)
{
  const auto trajectory = read("1403636580838555648,0,0,0,1,0,0,0\n"
                               "1403636581838555648,0,0,0,1,0,0,0\n");
  // Half a step of double at 1.4e18.
  EXPECT_NEAR(trajectory.stamps[0], 1403636580.838555648, 1e-6);
  EXPECT_NEAR(trajectory.stamps[1] - trajectory.stamps[0], 1, 1e-6);
  EXPECT_EQ(read("12 0 0 0 0 0 0 1\n").stamps.at(0), 12);
}

TEST_F(OfOthers, RowsThatAreBrokenAreNamed)
{
  const auto expectRefused = [&](const std::string& rows, const std::string& message) {
    expectIoFailed(file_, message, [&] { read(rows); });
  };
  expectRefused("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2\n",
                "line 1: the last four of 16 numbers are not 0 0 0 1");
  expectRefused(
      "1,0,0,0,0,1\n",
      "line 1: expected 12 numbers (KITTI) or 8 (TUM), or 9, 13, 16 or 17, got 6");
  expectRefused("stamp x y\n1 2 3 0 0 0 1 x\n", "line 2: 'x' is not a number");
  expectRefused("1 2 3 0 0 0 0 1\nstamp x y\n", "line 2: 'stamp' is not a number");
  expectRefused("0 0,5 0 0 0 0 0 1\n", "line 1: '0,5' is not a number");
}

TEST_F(OfOthers, StampsOfVerticesAreTheirIds)
{
  const std::string pose = " 0 0 0 0 0 1\n";
  writeText(folder_ / "a.g2o",
            "VERTEX_SE3:QUAT 11 3" + pose + "VERTEX_SE3:QUAT 2 1" + pose +
                "VERTEX_SE3:QUAT 7 2" + pose);
  const auto read = pcl6d::readTrajectoryFiles(folder_ / "a.g2o");
  EXPECT_EQ(read.trajectory.stamps, (std::vector<double>{2, 7, 11}));
  EXPECT_EQ(read.trajectory.poses[1].translation().x(), 2);
}
