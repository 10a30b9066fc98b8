// SPDX-License-Identifier: BSD-3-Clause
// Recordings of robots as the input of programs; the commands of share/doc/robots.md.
#include "apps/convert/convert_test.h"
#include "apps/support/corridor_run.h"
#include "sources/made_bag.h"
#include "sources/made_messages.h"
#include "support/folders.h"

#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace {
using namespace pcl6d::test;
namespace fs = std::filesystem;

constexpr std::int64_t kFirst = 1600000000000000000; // [ns]
constexpr std::int64_t kPause = 500000000; // [ns] 2 Hz: exact as a double, too
constexpr std::size_t kRecorded = 12;      // scans

/** \return the time [s] of a scan as a text without rounding */
std::string
secondsOf(std::int64_t time)
{
  char text[32];
  std::snprintf(text,
                sizeof text,
                "%lld.%09lld",
                static_cast<long long>(time / 1000000000),
                static_cast<long long>(time % 1000000000));
  return text;
}

/** \brief Scans of the corridor as a folder of files with poses, and as a recording. */
class Robots : public testing::Test {
protected:
  void
  SetUp() override
  {
    fs::create_directory(files_);
    const auto poses = pcl6d::readTrajectory(scans() / "odometry.txt").poses;
    std::string tum;
    for (std::size_t i = 0; i < kRecorded; ++i) {
      const std::int64_t time = kFirst + static_cast<std::int64_t>(i) * kPause;
      char name[16];
      std::snprintf(name, sizeof name, "scan%03zu.pcd", i);
      fs::copy(scans() / name, files_ / name);
      record(pcl6d::readScanCloud(scans() / name).cloud, poses[i], time);
      const Eigen::Quaterniond q(poses[i].linear());
      const Eigen::Vector3d t = poses[i].translation();
      tum += secondsOf(time);
      for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
        tum += " " + pcl6d::text::shortest(value);
      tum += "\n";
    }
    writeText(folder_ / "poses.tum", tum);
    writeText(folder_ / "drive.bag", rosBagOf(messages_));
  }

  void
  record(const pcl::PCLPointCloud2& cloud,
         const Eigen::Isometry3d& pose,
         std::int64_t time)
  {
    MadeCloud made;
    made.stamp = time;
    made.width = cloud.width * cloud.height;
    made.fields.clear();
    for (const auto& field : cloud.fields)
      made.fields.push_back({field.name, field.offset, field.datatype});
    made.point_step = cloud.point_step;
    made.data.assign(cloud.data.begin(), cloud.data.end());
    messages_.push_back({"/odom",
                         "nav_msgs/Odometry",
                         time,
                         odometryMessage(MadeEncoding::kRos1, time, pose, "lidar")});
    messages_.push_back({"/points",
                         "sensor_msgs/PointCloud2",
                         time + 1,
                         cloudMessage(MadeEncoding::kRos1, made)});
  }

  TempFolder folder_;
  fs::path files_ = folder_ / "files";
  std::vector<MadeMessage> messages_;
};

TEST_F(Robots, ARecordingGivesTheTrajectoryOfItsScansAsFiles)
{
  const Outcome of_bag = slam(folder_ / "drive.bag", folder_ / "A", {"--no-picture"});
  ASSERT_EQ(of_bag.exit_code, 0) << of_bag.err;
  EXPECT_NE((of_bag.out + of_bag.err).find("/odom (nav_msgs/Odometry)"),
            std::string::npos);
  const Outcome of_files =
      slam(files_,
           folder_ / "B",
           {"--no-picture", "--poses", (folder_ / "poses.tum").string()});
  ASSERT_EQ(of_files.exit_code, 0) << of_files.err;
  for (const char* const name : {"trajectory.kitti", "trajectory.tum", "graph.g2o"})
    EXPECT_EQ(readText(folder_ / "A" / name), readText(folder_ / "B" / name)) << name;
}

TEST_F(Robots, AFolderOfRos2IsAnInputOfAllPrograms)
{
  MadeBagOptions options;
  options.compression = "zstd";
  const fs::path recording = folder_ / "drive";
  fs::create_directory(recording);
  writeText(recording / "drive_0.mcap", mcapOf(messages_, options));
  writeText(
      recording / "metadata.yaml",
      "rosbag2_bagfile_information:\n  relative_file_paths:\n    - drive_0.mcap\n");
  const Outcome outcome =
      slam(recording, folder_ / "A", {"--no-picture", "--last", "3", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string info = converted({"info", recording.string()});
  EXPECT_NE(info.find("MCAP, 24 messages, 5.500 s\n"), std::string::npos) << info;
  EXPECT_NE(info.find("topic /points       12  sensor_msgs/PointCloud2"),
            std::string::npos)
      << info;
  EXPECT_NE(info.find("12 scans, "), std::string::npos) << info;
  EXPECT_NE(info.find("times: 1600000000.000 s to 1600000005.500 s"),
            std::string::npos);
  converted({"scans",
             recording.string(),
             "-o",
             (folder_ / "out").string(),
             "--format",
             "pcd"});
  const auto written = pcl6d::readScan(folder_ / "out" / "scan007.pcd");
  const auto original = pcl6d::readScan(scans() / "scan007.pcd");
  EXPECT_EQ(written.points.size(), original.points.size());
  EXPECT_EQ(written.points.back(), original.points.back());
}

TEST_F(Robots, WrongChoicesAreErrorsOfOneLine)
{
  const auto bag = folder_ / "drive.bag";
  expectError(
      slam(bag, folder_ / "A", {"--topic", "/odom"}),
      "pcl_slam6d",
      1,
      {"--topic /odom: the topic holds nav_msgs/Odometry", "choose one of /points"});
  expectError(slam(bag, folder_ / "A", {"--time", "yesterday"}),
              "pcl_slam6d",
              2,
              {"time", "auto, header or record"});
  expectConvertError(
      {"scans",
       bag.string(),
       "-o",
       (folder_ / "o").string(),
       "--format",
       "pcd",
       "--odometry",
       "/points"},
      1,
      {"--odometry /points", "must hold Odometry, PoseStamped or NavSatFix"});
  expectError(slam(bag, folder_ / "A", {"--imu", "/odom"}),
              "pcl_slam6d",
              1,
              {"--imu /odom: the topic holds nav_msgs/Odometry, but must hold Imu"});
  messages_.erase(messages_.begin() + 1, messages_.end());
  writeText(folder_ / "odom.bag", rosBagOf(messages_));
  expectError(slam(folder_ / "odom.bag", folder_ / "A"),
              "pcl_slam6d",
              1,
              {"no topic holds clouds", "/odom (nav_msgs/Odometry, 1 message)"});
  const std::string info = converted({"info", (folder_ / "odom.bag").string()});
  EXPECT_NE(info.find("scans: 0, no topic holds clouds"), std::string::npos) << info;
}

TEST_F(Robots, ACutRecordingIsAnInputAndSaysSo)
{
  const std::string whole = readText(folder_ / "drive.bag");
  writeText(folder_ / "cut.bag", whole.substr(0, whole.size() * 3 / 4));
  const Outcome outcome =
      slam(folder_ / "cut.bag", folder_ / "A", {"--no-picture", "--last", "3"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE((outcome.out + outcome.err).find("cut off or still being written"),
            std::string::npos)
      << outcome.out << outcome.err;
}

/** \return the commands of all blocks of a document, without their comments */
std::vector<std::string>
commandsOf(const fs::path& document)
{
  const std::string content = readText(document), fence = "```sh\n";
  std::vector<std::string> commands;
  for (auto begin = content.find(fence); begin != std::string::npos;
       begin = content.find(fence, begin + 1)) {
    const std::size_t first = begin + fence.size();
    const std::string block = content.substr(first, content.find("```", first) - first);
    pcl6d::text::Lines lines(block);
    while (lines.next()) {
      const std::string_view line = lines.line();
      commands.emplace_back(line.substr(0, line.find('#')));
    }
  }
  return commands;
}

TEST_F(Robots, TheCommandsOfTheDocumentMakeMaps)
{
  const auto commands = commandsOf(PCL6D_SOURCE_DIR "/share/doc/robots.md");
  ASSERT_EQ(commands.size(), 7u);
  const std::vector<std::string> files = {
      "drive.bag", "OUT", "map.bt", "map.yaml", "dem.tif", "trajectory.mcap"};
  for (const std::string& command : commands) {
    pcl6d::text::Tokens tokens(command);
    const std::string program(tokens.next());
    std::vector<std::string> arguments;
    for (auto token = tokens.next(); !token.empty(); token = tokens.next())
      arguments.push_back(std::find(files.begin(), files.end(), token) != files.end()
                              ? (folder_ / std::string(token)).string()
                              : std::string(token));
    const Outcome outcome = runProgram(program, arguments);
    if (outcome.err.find("needs GDAL") != std::string::npos)
      continue; // built without
    ASSERT_EQ(outcome.exit_code, 0) << command << '\n' << outcome.err;
  }
  EXPECT_TRUE(fs::exists(folder_ / "OUT" / "report.html"));
  EXPECT_TRUE(fs::exists(folder_ / "OUT" / "map.pcd"));
  for (const char* const file : {"map.bt", "map.yaml", "map.pgm", "trajectory.mcap"})
    EXPECT_TRUE(fs::exists(folder_ / file)) << file;
  // Stamps of the recording go through the run into the new one.
  const std::string info = converted({"info", (folder_ / "trajectory.mcap").string()});
  EXPECT_NE(info.find("nav_msgs/Odometry"), std::string::npos) << info;
}

} // namespace
