// SPDX-License-Identifier: BSD-3-Clause
// Keyframes of a recording with odometry at 10 Hz, and folders of data sets as input of programs.
#include "apps/convert/convert_test.h"
#include "apps/support/corridor_run.h"
#include "apps/support/simulated_drive.h"
#include "sources/made_bag.h"
#include "sources/made_messages.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/trajectory_io.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace {
using namespace pcl6d::test;
namespace fs = std::filesystem;

constexpr std::int64_t kDriveStart = 1600000000000000000; // [ns]
constexpr std::int64_t kSweep = 100000000;                // [ns]
constexpr int kSweeps = 64;

/** \return the points of a sweep as a message */
std::string
sweepMessage(const fs::path& file, std::int64_t time)
{
  const auto scan = pcl6d::readScan(file);
  std::vector<Eigen::Vector3f> points(scan.points.begin(), scan.points.end());
  return cloudMessage(MadeEncoding::kRos1, plainCloud(time, points));
}

/** Records the sweeps with their true poses, on the lidar, as odometry. */
void
writeDrive(const fs::path& bag)
{
  const auto poses = pcl6d::readTrajectory(simulatedDrive() / "groundtruth.txt").poses;
  std::vector<MadeMessage> messages;
  for (int i = 0; i < kSweeps; ++i) {
    const std::int64_t time = kDriveStart + i * kSweep;
    char name[16];
    std::snprintf(name, sizeof name, "scan%03d.pcd", i);
    messages.push_back(
        {"/odom",
         "nav_msgs/Odometry",
         time,
         odometryMessage(
             MadeEncoding::kRos1, time, poses[static_cast<std::size_t>(i)], "lidar")});
    messages.push_back({"/points",
                        "sensor_msgs/PointCloud2",
                        time + 1,
                        sweepMessage(simulatedDrive() / name, time)});
  }
  writeText(bag, rosBagOf(messages));
}

TEST(RobotKeyframes, ARecordingWithPosesGivesKeyframesAndAllPoses)
{
  const TempFolder folder;
  writeDrive(folder / "drive.bag");
  const fs::path out = folder / "out";
  const Outcome outcome = slam(folder / "drive.bag", out, {"--no-picture"});
  ASSERT_NE(outcome.exit_code, 1) << outcome.err;
  EXPECT_NE((outcome.out + outcome.err).find("(keyframes of 64 sweeps)"),
            std::string::npos)
      << outcome.out << outcome.err;
  const auto summary = nlohmann::json::parse(readText(out / "summary.json"));
  EXPECT_EQ(summary["drive"]["files"].size(), 64u);
  EXPECT_NEAR(summary["drive"]["seconds"], 6.3, 1e-6); // stamps as double
  EXPECT_NEAR(summary["drive"]["path_length"], 9.45, 0.3);
  EXPECT_EQ(
      summary["pose_source"],
      "tracking in the order of the files (0 of 64 scans lost), begun with the pose "
      "of /odom (nav_msgs/Odometry)");
  EXPECT_LT(summary["scans"].size(), 20u);
  EXPECT_GT(summary["scans"].size(), 2u);
  const auto truth = pcl6d::readTrajectory(simulatedDrive() / "groundtruth.txt").poses;
  const auto found = pcl6d::readTrajectory(out / "trajectory.tum");
  ASSERT_EQ(found.poses.size(), truth.size());
  EXPECT_NEAR(found.stamps[63] - found.stamps[0], 6.3, 1e-6);
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_LT(pcl6d::distanceBetween(found.poses[0].inverse() * found.poses[i],
                                     truth[0].inverse() * truth[i])
                  .translation,
              0.06) // half a voxel of 0.12 m
        << i;
}

TEST(RobotKeyframes, GivenPosesAreTakenAsTheyAreIfThatIsAsked)
{
  const TempFolder folder;
  writeDrive(folder / "drive.bag");
  const fs::path out = folder / "out";
  const Outcome outcome =
      slam(folder / "drive.bag",
           out,
           {"--start", "poses", "--no-picture", "--no-verification"});
  ASSERT_NE(outcome.exit_code, 1) << outcome.err;
  const auto summary = nlohmann::json::parse(readText(out / "summary.json"));
  EXPECT_EQ(summary["drive"]["files"].size(), 64u);
  EXPECT_EQ(summary["pose_source"], "/odom (nav_msgs/Odometry)");
  EXPECT_LT(summary["scans"].size(), 20u);
}

TEST(RobotKeyframes, EachSweepIsAScanIfThatIsAsked)
{
  const TempFolder folder;
  writeDrive(folder / "drive.bag");
  const Outcome outcome = runProgram(
      "pcl_slam6d",
      {(folder / "drive.bag").string(), "-o", "x", "--every", "1", "--explain"});
  EXPECT_NE(outcome.out.find("64 scans, initial poses from /odom"), std::string::npos)
      << outcome.out << outcome.err;
}

TEST(DataSets, AFolderOfKittiIsNamedByTheProgramsAndGivesStamps)
{
  const TempFolder folder;
  const fs::path sequence = folder / "kitti/sequences/00";
  fs::create_directories(sequence / "velodyne");
  for (int i = 0; i < 3; ++i) {
    char name[16];
    std::snprintf(name, sizeof name, "scan%03d.pcd", i);
    const auto scan = pcl6d::readScan(scans() / name);
    std::string bytes;
    for (const Eigen::Vector3f& p : scan.points) {
      bytes.append(reinterpret_cast<const char*>(p.data()), 12);
      bytes.append("\0\0\0\x3f", 4); // intensity 0.5
    }
    writeText(sequence / "velodyne" / ("00000" + std::to_string(i) + ".bin"), bytes);
  }
  writeText(sequence / "times.txt", "0\n0.1\n0.2\n");
  writeText(sequence / "calib.txt", "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n");
  const std::string info = converted({"info", (folder / "kitti").string()});
  EXPECT_NE(info.find("data set KITTI odometry; points xyzi; x forward, y left, z up "
                      "[m]; stamps of times.txt; times of points: none: sweeps are "
                      "deskewed already; calibration calib.txt; scans in "),
            std::string::npos)
      << info;
  EXPECT_NE(info.find("times: 0.000 s to 0.200 s"), std::string::npos) << info;
  const Outcome outcome =
      slam(folder / "kitti", folder / "out", {"--no-picture", "--no-verification"});
  ASSERT_NE(outcome.exit_code, 1) << outcome.err;
  EXPECT_NE((outcome.out + outcome.err).find("data set KITTI odometry"),
            std::string::npos)
      << outcome.out << outcome.err;
  EXPECT_EQ(pcl6d::readTrajectory(folder / "out/trajectory.tum").stamps,
            (std::vector<double>{0, 0.1, 0.2}));
}
} // namespace
