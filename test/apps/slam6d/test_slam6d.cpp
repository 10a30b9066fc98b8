// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d as a user runs it, on scans of the simulator.
#include "apps/support/corridor_run.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/frames_io.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_writer.h>
#include <pcl6d/io/trajectory_io.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::contentOf;
using pcl6d::test::kScans;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::scans;
using pcl6d::test::slam;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

const std::vector<std::string> kFew = {"--last", std::to_string(kScans - 1)};

double
positionRms(const pcl6d::Trajectory& a, const pcl6d::Trajectory& b, std::size_t count)
{
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i)
    sum += (a.poses[i].translation() - b.poses[i].translation()).squaredNorm();
  return std::sqrt(sum / static_cast<double>(count));
}
} // namespace

TEST(PclSlam6d, WritesTheRunFolderAndImprovesThePoses)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  const Outcome outcome = slam(scans(), out, kFew);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("all 16 scans registered"), std::string::npos)
      << outcome.out;
  for (const char* file : {"trajectory.kitti",
                           "trajectory.tum",
                           "map.pcd",
                           "summary.json",
                           "top_view.png",
                           "frames/scan000.frames",
                           "scans/scan015.pcd"}) {
    EXPECT_TRUE(fs::is_regular_file(out / file)) << file;
    EXPECT_GT(fs::file_size(out / file), 0u) << file;
  }
  const auto truth = pcl6d::readTrajectory(scans() / "groundtruth.txt");
  const auto odometry = pcl6d::readTrajectory(scans() / "odometry.txt");
  const auto poses = pcl6d::readTrajectory(out / "trajectory.kitti");
  ASSERT_EQ(poses.poses.size(), std::size_t{kScans});
  EXPECT_LT(positionRms(poses, truth, kScans),
            0.2 * positionRms(odometry, truth, kScans));
}

TEST(PclSlam6d, DrawsNoPictureIfToldSo)
{
  const TempFolder folder;
  const Outcome outcome =
      slam(scans(), folder / "out", {"--last", "1", "--no-picture"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_FALSE(fs::exists(folder / "out" / "top_view.png"));
  EXPECT_TRUE(fs::exists(folder / "out" / "map.pcd"));
}

TEST(PclSlam6d, TellsWhereTheTimeWentIfAsked)
{
  const TempFolder folder;
  const Outcome outcome =
      slam(scans(), folder / "out", {"--last", "2", "--no-picture", "--timing"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::map<std::string, double> seconds; // by the first word of a line
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);)
    if (const auto at = line.find(" s"); line.rfind("  ", 0) == 0 && at != line.npos) {
      std::istringstream words(line);
      std::string name;
      words >> name;
      seconds[name] = std::stod(line.substr(std::min<std::size_t>(26, line.size())));
    }
  ASSERT_EQ(seconds.count("reading"), 1u) << outcome.out;
  ASSERT_EQ(seconds.count("scan"), 1u) << outcome.out;
  EXPECT_NEAR(seconds["together"],
              seconds["reading"] + seconds["matching"] + seconds["writing"],
              0.02);
  EXPECT_GE(seconds["matching"] + 0.01, seconds["scan"] + seconds["relaxation"]);
}

TEST(PclSlam6d, WritesTheSamePosesEverywhere)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  ASSERT_EQ(slam(scans(), out, kFew).exit_code, 0);
  const auto kitti = pcl6d::readTrajectory(out / "trajectory.kitti");
  const auto tum = pcl6d::readTrajectory(out / "trajectory.tum");
  const auto json = nlohmann::json::parse(readText(out / "summary.json"));
  for (int i = 0; i < kScans; ++i) {
    char name[16];
    std::snprintf(name, sizeof name, "scan%03d", i);
    const auto viewpoint =
        pcl6d::readPcdViewpoint(out / "scans" / (std::string(name) + ".pcd"));
    const auto frames =
        pcl6d::readFrames(out / "frames" / (std::string(name) + ".frames"));
    ASSERT_GE(frames.size(), 2u); // as given, and after each stage
    Eigen::Isometry3d from_json;
    const auto& numbers = json["scans"][i]["T_world_scan"];
    for (int k = 0; k < 16; ++k)
      from_json.matrix()(k / 4, k % 4) = numbers[k];
    EXPECT_EQ(tum.stamps[i], i);
    for (const auto& pose :
         {tum.poses[i], viewpoint, frames.back().T_world_scan, from_json}) {
      const auto error = pcl6d::distanceBetween(kitti.poses[i], pose);
      EXPECT_LT(error.translation, 1e-12); // 17 digits, coordinates of some 10 m
      EXPECT_LT(error.rotation, 1e-12);
    }
  }
}

TEST(PclSlam6d, SummaryTellsOptionsStagesScansAndVerdict)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  ASSERT_EQ(slam(scans(), out, {"--last", "3", "--voxel", "0.1"}).exit_code, 0);
  const auto json = nlohmann::json::parse(readText(out / "summary.json"));
  EXPECT_EQ(json["schema_version"], 2);
  EXPECT_EQ(json["world_offset"], (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(json["pose_source"], "odometry.txt");
  EXPECT_EQ(json["options"]["voxel"]["source"], "given");
  EXPECT_EQ(json["options"]["voxel"]["value"], "0.1");
  EXPECT_EQ(json["options"]["max-distance"]["source"], "derived");
  EXPECT_FALSE(json["options"]["max-distance"]["why"].get<std::string>().empty());
  EXPECT_EQ(json["options"]["metascan"]["source"], "default");
  EXPECT_TRUE(json["verdict"]["reliable"]);
  EXPECT_TRUE(json["verdict"]["complete"]);
  EXPECT_EQ(json["totals"]["scans"], 4);
  std::set<std::string> stages;
  for (const auto& stage : json["stages"]) {
    stages.insert(stage["name"]);
    EXPECT_GT(stage["peak_memory_mb"], 1);
  }
  EXPECT_EQ(stages, (std::set<std::string>{"reading", "matching", "writing"}));
  ASSERT_EQ(json["scans"].size(), 4u);
  EXPECT_EQ(json["scans"][0]["state"], "fixed");
  const auto& scan = json["scans"][2];
  EXPECT_EQ(scan["file"], "scan002.pcd");
  EXPECT_EQ(scan["state"], "matched");
  EXPECT_GT(scan["overlap"], 0.5);
  ASSERT_EQ(scan["covariance"].size(), 6u);
  EXPECT_GT(scan["covariance"][0][0], 0);
}

TEST(PclSlam6d, GivesTheSameBytesForEveryThreadCount)
{
  const TempFolder folder;
  std::string expected;
  for (const char* threads : {"1", "2", "8"}) {
    const fs::path out = folder / threads;
    ASSERT_EQ(slam(scans(), out, {"--last", "7", "--threads", threads}).exit_code, 0);
    const std::string poses = readText(out / "trajectory.kitti") +
                              readText(out / "map.pcd") +
                              readText(out / "scans" / "scan007.pcd");
    if (expected.empty())
      expected = poses;
    EXPECT_TRUE(poses == expected) << threads << " threads";
  }
}

TEST(PclSlam6d, PrintedParametersGiveTheSameRun)
{
  const TempFolder folder;
  ASSERT_EQ(slam(scans(), folder / "auto", {"--last", "5"}).exit_code, 0);
  const auto json = nlohmann::json::parse(readText(folder / "auto" / "summary.json"));
  std::vector<std::string> arguments = {"--last", "5"};
  for (const char* name :
       {"voxel", "max-distance", "max-distance-start", "min-range"}) {
    arguments.push_back(std::string("--") + name);
    arguments.push_back(json["options"][name]["value"]);
  }
  ASSERT_EQ(slam(scans(), folder / "given", arguments).exit_code, 0);
  EXPECT_EQ(readText(folder / "auto" / "trajectory.kitti"),
            readText(folder / "given" / "trajectory.kitti"));
}

TEST(PclSlam6d, TakesALineSpacing)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  ASSERT_EQ(slam(scans(), out, {"--last", "1", "--line-spacing", "0.2"}).exit_code, 0);
  const auto options = nlohmann::json::parse(readText(out / "summary.json"))["options"];
  EXPECT_EQ(options["line-spacing"]["value"], "0.2");
  EXPECT_EQ(options["voxel"]["value"], "0.26");
  const Outcome both = slam(scans(),
                            folder / "both",
                            {"--last", "1", "--line-spacing", "0.2", "--voxel", "0.1"});
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_NE((both.out + both.err).find("no effect in this run: --line-spacing"),
            std::string::npos)
      << both.out << both.err;
  expectError(slam(scans(), folder / "bad", {"--line-spacing", "-1"}),
              "pcl_slam6d",
              2,
              {"--line-spacing = -1"});
}

TEST(PclSlam6d, NeverReadsGroundTruth)
{
  const TempFolder folder;
  const fs::path in = folder / "in";
  fs::copy(scans(), in);
  ASSERT_EQ(slam(in, folder / "a", {"--last", "3"}).exit_code, 0);
  writeText(in / "groundtruth.txt", "not a pose at all\n");
  writeText(in / "groundtruth.pcd", "not a scan at all\n");
  ASSERT_EQ(slam(in, folder / "b", {"--last", "3"}).exit_code, 0);
  EXPECT_EQ(readText(folder / "a" / "trajectory.kitti"),
            readText(folder / "b" / "trajectory.kitti"));
}

TEST(PclSlam6d, OneScanIsAMapOfOneScan)
{
  const TempFolder folder;
  const Outcome outcome =
      slam(scans(), folder / "out", {"--first", "7", "--last", "7"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(folder / "out" / "scans" / "scan007.pcd"));
  EXPECT_TRUE(fs::exists(folder / "out" / "map.pcd"));
}

TEST(PclSlam6d, SaysWhichScanCouldNotBeMatched)
{
  const TempFolder folder;
  const fs::path in = folder / "in";
  fs::create_directory(in);
  for (const char* name : {"scan000.pcd", "scan001.pcd", "scan003.pcd"})
    fs::copy(scans() / name, in / name);
  // Scan 2 sees a single wall 500 m away, where nobody else sees anything.
  std::string wall = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
                     "WIDTH 100\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 100\n"
                     "DATA ascii\n";
  for (int i = 0; i < 100; ++i)
    wall += std::to_string(500 - i / 2) + " " + std::to_string(4 * (i % 10)) + " " +
            std::to_string(i / 10) + "\n";
  writeText(in / "scan002.pcd", wall);
  writeText(in / "odometry.txt", [&] {
    std::istringstream rows(readText(scans() / "odometry.txt"));
    std::string four, row;
    for (int i = 0; i < 4 && std::getline(rows, row); ++i)
      four += row + "\n";
    return four;
  }());
  const Outcome outcome = slam(in, folder / "out");
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.out.find("scan002.pcd"), std::string::npos) << outcome.out;
  const auto json = nlohmann::json::parse(readText(folder / "out" / "summary.json"));
  EXPECT_EQ(json["scans"][2]["state"], "predicted");
  EXPECT_EQ(json["scans"][3]["state"], "matched");
  EXPECT_FALSE(json["verdict"]["reliable"]);
  const auto odometry = pcl6d::readTrajectory(in / "odometry.txt");
  const auto poses = pcl6d::readTrajectory(folder / "out" / "trajectory.kitti");
  const auto predicted =
      pcl6d::extrapolateOdometry(poses.poses[1], odometry.poses[1], odometry.poses[2]);
  EXPECT_LT(pcl6d::distanceBetween(predicted, poses.poses[2]).translation, 1e-9);
}

TEST(PclSlam6d, KeepsTheDigitsOfNationalCoordinates)
{
  const TempFolder folder;
  auto odometry = pcl6d::readTrajectory(scans() / "odometry.txt");
  const Eigen::Vector3d far(691234.567, 5336789.123, 512.4);
  for (auto& pose : odometry.poses)
    pose.translation() += far;
  pcl6d::writeTrajectoryKitti(folder / "utm.txt", odometry);
  ASSERT_EQ(slam(scans(), folder / "near", kFew).exit_code, 0);
  std::vector<std::string> arguments = kFew;
  arguments.insert(arguments.end(), {"--poses", (folder / "utm.txt").string()});
  ASSERT_EQ(slam(scans(), folder / "far", arguments).exit_code, 0);
  const auto near = pcl6d::readTrajectory(folder / "near" / "trajectory.kitti");
  const auto moved = pcl6d::readTrajectory(folder / "far" / "trajectory.kitti");
  // The grid of the metascan lies otherwise: equal up to the noise of the reduction.
  for (std::size_t i = 0; i < near.poses.size(); ++i)
    EXPECT_LT((moved.poses[i].translation() - near.poses[i].translation() - far).norm(),
              0.01);
  const auto json = nlohmann::json::parse(readText(folder / "far" / "summary.json"));
  EXPECT_EQ(json["world_offset"], (std::vector<double>{691235, 5336789, 512}));
  const auto viewpoint =
      pcl6d::readPcdViewpoint(folder / "far" / "scans" / "scan000.pcd");
  EXPECT_NEAR(viewpoint.translation().x(), -0.433, 1e-6);
}

TEST(PclSlam6d, ReplacesAnEarlierRunWhole)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  ASSERT_EQ(slam(scans(), out, {"--last", "4"}).exit_code, 0);
  ASSERT_EQ(slam(scans(), out, {"--last", "2"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(out / "scans" / "scan004.pcd"));
  EXPECT_FALSE(fs::exists(out / "frames" / "scan004.frames"));
  EXPECT_EQ(pcl6d::readTrajectory(out / "trajectory.kitti").poses.size(), 3u);
}

TEST(PclSlam6d, CommandLineWinsOverConfig)
{
  const TempFolder folder;
  const std::string config = folder / "run.cfg";
  writeText(config, "# a comment\nvoxel = 0.2\nlast = 2\nquiet = true\n");
  const Outcome outcome =
      slam(scans(), folder / "out", {"--config", config, "--last", "1"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out + outcome.err, ""); // quiet
  const auto json = nlohmann::json::parse(readText(folder / "out" / "summary.json"));
  EXPECT_EQ(json["options"]["voxel"]["value"], "0.2");
  EXPECT_EQ(json["totals"]["scans"], 2);
}

TEST(PclSlam6d, HelpShowsGroupsUnitsAndDefaults)
{
  const Outcome outcome = pcl6d::test::runProgram("pcl_slam6d", {"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* text :
       {"usage: pcl_slam6d SCAN_DIR|SITE.e57|DRIVE.bag|FILE FILE ... -o OUT_DIR",
        "Input:",
        "Matching:",
        "--metascan",
        "[m]",
        "(=auto)",
        "--threads"})
    EXPECT_NE(outcome.out.find(text), std::string::npos) << text;
}

TEST(PclSlam6d, SeveralFilesAreOneRunInTheOrderGiven)
{
  const TempFolder folder;
  const auto cloud = pcl6d::readPcd(scans() / "scan001.pcd");
  const auto odometry = pcl6d::readTrajectory(scans() / "odometry.txt");
  pcl6d::writeScan(folder / "b.ptx", cloud, odometry.poses[1]);
  for (const int i : {0, 2}) { // with their poses in the files
    const std::string name = "scan00" + std::to_string(i) + ".pcd";
    pcl6d::writePcd(folder / name,
                    pcl6d::readPcd(scans() / name),
                    odometry.poses[static_cast<std::size_t>(i)]);
  }
  const Outcome outcome = pcl6d::test::runProgram("pcl_slam6d",
                                                  {folder / "scan000.pcd",
                                                   folder / "b.ptx",
                                                   folder / "scan002.pcd",
                                                   "-o",
                                                   folder / "out",
                                                   "--no-picture"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("3 scans, initial poses from the files"),
            std::string::npos)
      << outcome.err;
  const auto summary = nlohmann::json::parse(readText(folder / "out" / "summary.json"));
  EXPECT_EQ(summary["scans"][0]["file"], "scan000.pcd");
  EXPECT_EQ(summary["scans"][1]["file"], "b");
  EXPECT_EQ(summary["scans"][2]["file"], "scan002.pcd");
  const auto truth = pcl6d::readTrajectory(scans() / "groundtruth.txt");
  const auto result = pcl6d::readTrajectory(folder / "out" / "trajectory.kitti");
  EXPECT_LT(positionRms(result, truth, 3),
            0.05); // [m] half of the odometry's error or less
}
