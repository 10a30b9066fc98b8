// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d --join: two maps of one site, without common poses, become one.
#include "apps/support/joined_rooms.h"
#include "apps/support/program_names.h"

#include <pcl6d/io/scan_reader.h>

#include <algorithm>

namespace {
namespace fs = std::filesystem;
using pcl6d::poseFromEuler;
using pcl6d::test::Join;
using pcl6d::test::kMonday;
using pcl6d::test::kSlam6d;
using pcl6d::test::kTuesday;
using pcl6d::test::Outcome;
using pcl6d::test::placeInRoom;
using pcl6d::test::readText;
using pcl6d::test::runProgram;
using Drive = pcl6d::test::JoinedRooms::Drive;

} // namespace

TEST_F(Join, BringsTheSecondRunIntoTheWorldOfTheFirst)
{
  const Outcome outcome = rooms().join({"monday", "tuesday"}, "both", {});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  expectPlaces("both", {0, 2, 4, 5, 3, 1}, kMonday);
  EXPECT_TRUE(
      pcl6d::test::sameBits(rooms().poses("both")[0], rooms().poses("monday")[0]));
  const std::string joined = "joined " + (rooms() / "tuesday").string() +
                             " (3 scans) to " + (rooms() / "monday").string() +
                             " (3 scans)";
  EXPECT_NE(outcome.out.find(joined), std::string::npos) << outcome.out;
  for (const char* file : {"map.pcd", "top_view.png", "graph.g2o", "verification.csv"})
    EXPECT_TRUE(fs::exists(rooms() / "both" / file)) << file;
  const auto summary = rooms().summary("both");
  EXPECT_TRUE(summary["verdict"]["reliable"]);
  EXPECT_NE(summary["verdict"]["text"].get<std::string>().find(joined),
            std::string::npos);
  EXPECT_EQ(summary["verification"]["verdict"], "good");
  EXPECT_EQ(summary["options"]["join"]["source"], "given");
  EXPECT_EQ(summary["options"]["initial-guess"]["value"], "global");
  EXPECT_EQ(summary["graph"]["stages"].back()["name"], "relaxation");
  EXPECT_EQ(summary["warnings"].size(), 0u) << summary["warnings"];
}

TEST_F(Join, TellsTheScansOfTheRunsApart)
{
  ASSERT_EQ(rooms().join({"monday", "tuesday"}, "named").exit_code, 0);
  const auto summary = rooms().summary("named");
  std::vector<std::string> names;
  std::vector<int> indices;
  for (const auto& scan : summary["scans"]) {
    names.push_back(scan["file"]);
    indices.push_back(scan["index"]);
  }
  EXPECT_EQ(names,
            (std::vector<std::string>{"scan000.xyz",
                                      "scan001.xyz",
                                      "scan002.xyz",
                                      "tuesday_scan000.xyz",
                                      "tuesday_scan001.xyz",
                                      "tuesday_scan002.xyz"}));
  EXPECT_EQ(indices, (std::vector<int>{0, 1, 2, 3, 4, 5}));
  for (const int i : indices)
    EXPECT_TRUE(
        fs::exists(rooms() / "named/scans" / ("scan00" + std::to_string(i) + ".pcd")));
  EXPECT_EQ(summary["scans"][0]["state"], "fixed");
  for (std::size_t i = 1; i < 6; ++i)
    EXPECT_EQ(summary["scans"][i]["state"], "matched") << i;
}

TEST_F(Join, KeepsNamesThatDiffer)
{
  Drive other{{5, 3}, kTuesday};
  other.name = "hall";
  rooms().run("hall", other);
  ASSERT_EQ(rooms().join({"monday", "hall"}, "kept").exit_code, 0);
  EXPECT_EQ(rooms().summary("kept")["scans"][3]["file"], "hall000.xyz");
}

TEST_F(Join, TakesTheCoarserVoxelAndSaysSo)
{
  const auto voxelOf = [&](const std::string& run) {
    return std::stod(
        rooms().summary(run)["options"]["voxel"]["value"].get<std::string>());
  };
  ASSERT_LT(voxelOf("monday"), voxelOf("tuesday"));
  const Outcome outcome = rooms().join({"monday", "tuesday"}, "coarse");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(voxelOf("coarse"), voxelOf("tuesday"));
  EXPECT_EQ(rooms().summary("coarse")["options"]["voxel"]["why"],
            "the coarsest of the runs");
  EXPECT_NE(outcome.err.find("the coarsest of the runs"), std::string::npos)
      << outcome.err;
  ASSERT_EQ(rooms()
                .join({"monday", "tuesday"}, "own", {"--voxel", "0.25", "--no-picture"})
                .exit_code,
            0);
  EXPECT_EQ(voxelOf("own"), 0.25);
}

TEST_F(Join, GivesTheSameBytesForAnyNumberOfThreads)
{
  ASSERT_EQ(rooms()
                .join({"monday", "tuesday"}, "one", {"--threads", "1", "--no-picture"})
                .exit_code,
            0);
  ASSERT_EQ(
      rooms()
          .join({"monday", "tuesday"}, "eight", {"--threads", "8", "--no-picture"})
          .exit_code,
      0);
  for (const char* file : {"trajectory.kitti", "map.pcd", "graph.g2o", "links.csv"})
    EXPECT_EQ(readText(rooms() / "one" / file), readText(rooms() / "eight" / file))
        << file;
}

TEST_F(Join, TheFirstRunGivesTheWorldWhicheverItIs)
{
  ASSERT_EQ(rooms().join({"tuesday", "monday"}, "swapped").exit_code, 0);
  expectPlaces("swapped", {5, 3, 1, 0, 2, 4}, kTuesday);
}

TEST_F(Join, TakesRunsOfOneScanAndMoreThanTwoRuns)
{
  Drive single{{1}, Eigen::Isometry3d::Identity()};
  single.seed = 11;
  rooms().run("single", single);
  ASSERT_EQ(rooms().join({"single", "monday"}, "onto_one").exit_code, 0);
  expectPlaces("onto_one", {1, 0, 2, 4}, Eigen::Isometry3d::Identity());
  const Outcome three = rooms().join({"monday", "tuesday", "single"}, "three");
  ASSERT_EQ(three.exit_code, 0) << three.err;
  expectPlaces("three", {0, 2, 4, 5, 3, 1, 1}, kMonday);
  EXPECT_NE(three.out.find("tuesday (3 scans) and "), std::string::npos) << three.out;
  EXPECT_EQ(rooms().summary("three")["scans"][6]["file"], "single_scan000.xyz");
}

TEST_F(Join, AJoinedRunGoesOnLikeAnyOther)
{
  ASSERT_EQ(rooms().join({"monday", "tuesday"}, "begun").exit_code, 0);
  const Eigen::Isometry3d T_world_room =
      rooms().poses("begun")[0] * placeInRoom(0).inverse();
  Drive further{{2, 3}, T_world_room};
  further.name = "further";
  rooms().writeScans("further", further);
  const Outcome outcome = runProgram(kSlam6d,
                                     {rooms() / "further.scans",
                                      "--continue",
                                      rooms() / "begun",
                                      "-o",
                                      rooms() / "grown",
                                      "--no-picture",
                                      "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expectPlaces("grown", {0, 2, 4, 5, 3, 1, 2, 3}, kMonday);
}

TEST_F(Join, FarWorldsKeepTheirDigits)
{
  const Eigen::Isometry3d far = poseFromEuler({3.3e6, 5.8e6, 400}, {0, 0, 1});
  rooms().run("far", {{0, 2}, far});
  ASSERT_EQ(rooms().join({"far", "tuesday"}, "at_far").exit_code, 0);
  expectPlaces("at_far", {0, 2, 5, 3, 1}, far);
  EXPECT_EQ(rooms().summary("at_far")["world_offset"],
            rooms().summary("far")["world_offset"]);
  ASSERT_EQ(rooms().join({"tuesday", "far"}, "from_far").exit_code, 0);
  expectPlaces("from_far", {5, 3, 1, 0, 2}, kTuesday);
  EXPECT_EQ(rooms().summary("from_far")["world_offset"], nlohmann::json({0, 0, 0}));
}

TEST_F(Join, ScansThatBothRunsHoldAreTakenOnce)
{
  const fs::path shared = rooms() / "shared.scans";
  Drive drive{{0, 1, 5}, kTuesday};
  drive.seed = 21;
  rooms().writeScans("shared", drive);
  fs::copy_file(rooms() / "monday.scans/scan002.xyz",
                shared / "scan001.xyz",
                fs::copy_options::overwrite_existing);
  pcl6d::Trajectory odometry;
  for (const int place : {0, 4, 5})
    odometry.poses.push_back(kTuesday * placeInRoom(place));
  pcl6d::writeTrajectoryKitti(shared / "odometry.txt", odometry);
  ASSERT_EQ(runProgram(kSlam6d,
                       {shared, "-o", rooms() / "sharing", "--no-picture", "--quiet"})
                .exit_code,
            0);
  const Outcome outcome = rooms().join({"monday", "sharing"}, "once");
  EXPECT_NE(outcome.err.find("sharing: 1 scan with the very same points"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(rooms().summary("once")["scans"].size(), 5u);
  EXPECT_EQ(rooms().summary("once")["warnings"].size(), 1u);
}

TEST_F(Join, PointsOutsideTheGateOfTheirRunStayOutside)
{
  Drive near{{5, 3, 1}, kTuesday};
  near.seed = 9;
  rooms().run("near", near, {"--max-range", "6"});
  const Outcome outcome = rooms().join({"monday", "near"}, "gated");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("outside the range gate of their own run"),
            std::string::npos)
      << outcome.err;
  double farthest[2] = {0, 0};
  for (const int scan : {0, 3})
    for (const auto& p : pcl6d::readScan(rooms() / "gated/scans" /
                                         ("scan00" + std::to_string(scan) + ".pcd"))
                             .points)
      farthest[scan / 3] = std::max<double>(farthest[scan / 3], p.norm());
  EXPECT_GT(farthest[0], 7) << "of the run without such a gate";
  EXPECT_LE(farthest[1], 6);
}
