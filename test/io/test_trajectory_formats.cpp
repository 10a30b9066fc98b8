// SPDX-License-Identifier: BSD-3-Clause
#include "io_test.h"
#include "support/poses.h"

#include <pcl6d/io/frames_io.h>
#include <pcl6d/io/pose_graph_io.h>
#include <pcl6d/io/trajectory_formats.h>
#include <pcl6d/io/trajectory_io.h>

using pcl6d::Frame;
using pcl6d::readTrajectoryFiles;
using pcl6d::readUosPose;
using pcl6d::TrajectoryFormat;
using pcl6d::writeUosPose;
using pcl6d::test::expectIoFailed;
using pcl6d::test::messageOf;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {
using Strings = std::vector<std::string>;

Eigen::Isometry3d
poseAt(double x)
{
  return Eigen::Isometry3d(Eigen::Translation3d(x, 2, 3));
}

std::vector<double>
positions(const pcl6d::TrajectoryFiles& files)
{
  std::vector<double> x;
  for (const auto& pose : files.trajectory.poses)
    x.push_back(pose.translation().x());
  return x;
}
} // namespace

TEST(UosPose, IsReadBackAsItWasWritten)
{
  const TempFolder folder;
  pcl6d::Random random(3);
  for (int i = 0; i < 300; ++i) {
    Eigen::Isometry3d pose = pcl6d::test::randomPose(random, 1e3, 3.1);
    if (i % 3 == 0) // gimbal lock of 3DTK's angles: about its y, our z, by 90 degrees
      pose.linear() = pcl6d::rotationFromVector({0, 0, i % 2 ? M_PI / 2 : -M_PI / 2}) *
                      pcl6d::rotationFromVector({random.uniform(-3, 3), 0, 0});
    writeUosPose(folder / "a.pose", pose);
    const auto error = pcl6d::distanceBetween(readUosPose(folder / "a.pose"), pose);
    EXPECT_LT(error.translation, 1e-12); // two roundings of 1e3 m: times and by 100
    EXPECT_LT(error.rotation, 1e-14) << i;
  }
}

TEST(UosPose, IsWrittenInCentimetresAndDegrees)
{
  const TempFolder folder;
  Eigen::Isometry3d pose = poseAt(1);
  pose.linear() = pcl6d::rotationFromVector({0, 0, -M_PI / 6}); // to the right
  writeUosPose(folder / "a.pose", pose);
  EXPECT_EQ(pcl6d::test::readText(folder / "a.pose").substr(0, 12), "-200 300 100");
  // 3DTK turns about y, which is up, from its z to its x: forward to the right.
  std::istringstream text(pcl6d::test::readText(folder / "a.pose"));
  double number[6] = {};
  for (double& n : number)
    text >> n;
  EXPECT_NEAR(number[3], 0, 1e-12);
  EXPECT_NEAR(number[4], 30, 1e-12);
  EXPECT_NEAR(number[5], 0, 1e-12);
}

TEST(TrajectoryFormats, HaveNamesAndExtensions)
{
  for (const char* const name : {"auto", "kitti", "tum", "g2o", "pose", "frames"})
    EXPECT_EQ(toString(pcl6d::trajectoryFormatFromName(name)), name);
  EXPECT_EQ(
      messageOf<pcl6d::BadArgument>([] { pcl6d::trajectoryFormatFromName("csv"); }),
      "format = 'csv', but must be auto, kitti, tum, g2o, pose or frames");
  EXPECT_EQ(pcl6d::trajectoryFormatOfExtension("a.b.TUM"), TrajectoryFormat::kTum);
  EXPECT_EQ(pcl6d::trajectoryFormatOfExtension("kitti"), TrajectoryFormat::kAuto);
  EXPECT_EQ(pcl6d::trajectoryFormatOfExtension("a.pose"), TrajectoryFormat::kAuto);
}

TEST(TrajectoryFormats, RowsAreToldApartByTheirColumns)
{
  const TempFolder folder;
  writeText(folder / "a.txt", "1 0 0 7 0 1 0 0 0 0 1 0\n");
  writeText(folder / "b.kitti", "5.5 8 0 0 0 0 0 1\n");
  EXPECT_EQ(readTrajectoryFiles(folder / "a.txt").format, TrajectoryFormat::kKitti);
  expectIoFailed(folder / "a.txt", "holds rows of kitti, not of tum", [&] {
    readTrajectoryFiles(folder / "a.txt", TrajectoryFormat::kTum);
  });
  expectIoFailed(folder / "b.kitti", "holds rows of tum, not of kitti", [&] {
    readTrajectoryFiles(folder / "b.kitti");
  });
  const auto tum = readTrajectoryFiles(folder / "b.kitti", TrajectoryFormat::kTum);
  EXPECT_EQ(tum.trajectory.stamps, std::vector<double>{5.5});
  EXPECT_EQ(positions(tum), std::vector<double>{8});
}

TEST(TrajectoryFormats, FoldersAreReadInNaturalOrder)
{
  const TempFolder folder;
  for (const int i : {10, 2, 1}) {
    const std::string name = "scan ü" + std::to_string(i);
    writeUosPose(folder / (name + ".pose"), poseAt(i));
    std::filesystem::create_directories(folder / "frames");
    pcl6d::writeFrames(folder / ("frames/" + name + ".frames"),
                       {Frame{poseAt(-1), {}}, Frame{poseAt(100 * i), {}}});
  }
  writeText(folder / "readme", "");
  writeText(folder / ".hidden.pose", "");
  const auto poses = readTrajectoryFiles(folder.path());
  EXPECT_EQ(poses.format, TrajectoryFormat::kPose);
  EXPECT_EQ(positions(poses), (std::vector<double>{1, 2, 10}));
  EXPECT_EQ(poses.names, (Strings{"scan ü1", "scan ü2", "scan ü10"}));
  EXPECT_EQ(poses.left_out, Strings{});
  const auto frames = readTrajectoryFiles(folder / "frames");
  EXPECT_EQ(frames.format, TrajectoryFormat::kFrames);
  EXPECT_EQ(positions(frames), (std::vector<double>{100, 200, 1000}));
  EXPECT_EQ(frames.left_out, Strings{"3 earlier poses of the scans"});
}

TEST(TrajectoryFormats, FoldersWithoutClearPosesAreRefused)
{
  const TempFolder folder;
  expectIoFailed(folder.path(), "holds no .pose and no .frames file", [&] {
    readTrajectoryFiles(folder.path());
  });
  writeUosPose(folder / "a.pose", poseAt(1));
  expectIoFailed(folder.path(), "holds no .frames file", [&] {
    readTrajectoryFiles(folder.path(), TrajectoryFormat::kFrames);
  });
  writeText(folder / "a.frames", "");
  expectIoFailed(folder.path(),
                 "holds .pose and .frames files; choose pose or frames",
                 [&] { readTrajectoryFiles(folder.path()); });
  expectIoFailed(folder / "a.frames", "holds no pose", [&] {
    readTrajectoryFiles(folder.path(), TrajectoryFormat::kFrames);
  });
  expectIoFailed(folder / "none", "No such file or directory", [&] {
    readTrajectoryFiles(folder / "none", TrajectoryFormat::kPose);
  });
}

TEST(TrajectoryFormats, OfAGraphTheVerticesAreRead)
{
  const TempFolder folder;
  writeText(folder / "a.g2o",
            "VERTEX_SE3:QUAT 7 1 2 3 0 0 0 1\nVERTEX_SE3:QUAT 9 4 5 6 0 0 0 1\n"
            "EDGE_SE3:QUAT 7 9 3 3 3 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 "
            "1\n");
  const auto graph = readTrajectoryFiles(folder / "a.g2o");
  EXPECT_EQ(graph.format, TrajectoryFormat::kG2o);
  EXPECT_EQ(positions(graph), (std::vector<double>{1, 4}));
  EXPECT_EQ(graph.left_out, (Strings{"1 edge"}));
}
