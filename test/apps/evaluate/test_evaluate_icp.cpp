// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate icp as a user runs it.
#include "apps/evaluate/csv_rows.h"
#include "apps/support/room_pair.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::evaluateIcp;
using pcl6d::test::readCsv;
using pcl6d::test::readText;
using pcl6d::test::RoomPair;
using pcl6d::test::without;
using pcl6d::test::writeText;
using Row = pcl6d::test::CsvRow;
} // namespace

TEST(EvaluateIcp, PrintsATableAndWritesItsFiles)
{
  const RoomPair pair;
  const fs::path out = pair / "out";
  const auto outcome = evaluateIcp(pair.arguments({"-o", out}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("warning"), std::string::npos) << outcome.err;
  for (const char* const word :
       {"start from odometry.txt",
        "27 runs each: x, y to +-0.2 m in 3 steps, yaw to +-3 deg in 3 steps",
        "max-distance = 0.34 m (auto: 1.7 x voxel, with normals)",
        "best pose of gicp",
        "small-angle",
        "approximate",
        "reach deg"})
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word << outcome.out;

  const auto rows = readCsv(out / "icp.csv");
  ASSERT_EQ(rows.size(), 11u); // point: 4 searches, 3 minimisers; plane and gicp: 2
  for (const Row& row : rows)
    EXPECT_EQ(row.at("runs"), "27");
  const auto runs = readCsv(out / "icp_runs.csv");
  ASSERT_EQ(runs.size(), 297u);
  EXPECT_DOUBLE_EQ(std::stod(runs[0].at("yaw")), -3 * M_PI / 180) << "radians in files";
  for (const char* const metric : {"point", "plane", "gicp"})
    for (const char* const kind : {"", "_yaw"}) {
      const fs::path picture =
          out / (std::string("icp_basin_") + metric + kind + ".png");
      EXPECT_EQ(readText(picture).substr(1, 3), "PNG") << picture;
    }
  const auto json = nlohmann::json::parse(readText(out / "icp.json"));
  EXPECT_EQ(json["generator"], "pcl_slam6d_evaluate");
  EXPECT_EQ(json["start"]["source"], "odometry.txt");
  EXPECT_EQ(json["x"].size(), 3u);
  ASSERT_EQ(json["best"].size(), 3u);
  EXPECT_TRUE(json["best"][1]["reliable"]);
  // Planes of a room with 5 mm noise fix the pose to a few millimetres.
  const auto T = json["best"][1]["T_a_b"];
  EXPECT_NEAR(T[3], pair.truth.translation().x(), 0.02);
  EXPECT_NEAR(T[7], pair.truth.translation().y(), 0.02);
  EXPECT_GE(json["best"][1]["sigma_position"], 0.02) << "voxel / 10";
}

TEST(EvaluateIcp, ShowsThatExactSearchesGiveTheSame)
{
  const RoomPair pair;
  std::vector<std::string> arguments = {pair / "a.xyz", pair / "b.xyz", "--quiet"};
  for (const char* const word : {"--voxel=0.3",
                                 "--offset-xy=2",
                                 "--offset-yaw=20",
                                 "--steps-xy=3",
                                 "--steps-yaw=3",
                                 "--metric=point",
                                 "--minimiser=quaternion",
                                 "--search=remembered",
                                 "--search=cached-tree",
                                 "--search=kdtree",
                                 "--search=octree",
                                 "--search=brute-force"})
    arguments.emplace_back(word);
  arguments.insert(arguments.end(), {"-o", pair / "out"});
  const auto searched = evaluateIcp(arguments);
  ASSERT_EQ(searched.exit_code, 0) << searched.err;
  const auto rows = readCsv(pair / "out/icp.csv");
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(without(rows, {"search", "seconds"}).size(), 1u);
  EXPECT_LT(std::stod(rows[0].at("success")), 1) << "or it would tell little";
  EXPECT_GT(std::stod(rows[0].at("success")), 0);
  EXPECT_EQ(without(readCsv(pair / "out/icp_runs.csv"), {"search", "seconds"}).size(),
            27u)
      << "the same runs to the last digit";
}

TEST(EvaluateIcp, GivesTheSameBitsForAnyNumberOfThreads)
{
  const RoomPair pair;
  for (const char* const threads : {"1", "3"}) {
    const auto outcome = evaluateIcp(pair.arguments({"--threads",
                                                     threads,
                                                     "--metric",
                                                     "gicp",
                                                     "--search",
                                                     "approximate",
                                                     "-o",
                                                     pair / threads}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  for (const char* const file : {"icp.csv", "icp_runs.csv"})
    EXPECT_EQ(without(readCsv(pair / "1" / file), {"seconds"}),
              without(readCsv(pair / "3" / file), {"seconds"}))
        << file;
  for (const char* const file :
       {"icp.json", "icp_basin_gicp.png", "icp_basin_gicp_yaw.png"})
    EXPECT_EQ(readText(pair / "1" / file), readText(pair / "3" / file)) << file;
}

TEST(EvaluateIcp, RunsAllCombinationsIfTold)
{
  const RoomPair pair;
  const auto count = [&](const std::vector<std::string>& words) {
    std::vector<std::string> arguments = {pair / "a.xyz", pair / "b.xyz"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    for (const char* const word :
         {"--quiet", "--voxel=0.3", "--steps-xy=1", "--steps-yaw=1"})
      arguments.emplace_back(word);
    const auto outcome = evaluateIcp(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto table = outcome.out.find("reach deg\n");
    EXPECT_NE(table, std::string::npos) << outcome.out;
    return std::count(outcome.out.begin() + table, outcome.out.end(), '\n') - 1;
  };
  EXPECT_EQ(count({"--metric=point", "--minimiser=all", "--search=all"}), 15);
  EXPECT_EQ(
      count(
          {"--metric=point", "--minimiser=all", "--search=all", "--all-combinations"}),
      63);
  EXPECT_EQ(count({"--metric=plane", "--metric=plane"}), 5);
}

TEST(EvaluateIcp, TakesAGuessInDegreesAndNoPosesThen)
{
  const RoomPair pair;
  writeText(pair / "odometry.txt", "broken");
  const auto outcome = evaluateIcp(
      pair.arguments({"--guess", "0.4 -0.2 0.05 1.1 -0.6 11.5", "--metric", "plane"}));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("start from --guess"), std::string::npos) << outcome.out;
  EXPECT_EQ(evaluateIcp(pair.arguments()).exit_code, 1) << "without it poses are read";
}

TEST(EvaluateIcp, PrintsTheTableAloneWhenQuiet)
{
  const RoomPair pair;
  const auto outcome =
      evaluateIcp(pair.arguments({"--quiet", "--metric=plane", "-o", pair / "out"}));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out.rfind("metric ", 0), 0u) << outcome.out;
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 6)
      << "names of columns, and five methods: " << outcome.out;
  EXPECT_TRUE(fs::exists(pair / "out/icp.json"));
}

TEST(EvaluateIcp, Helps)
{
  const auto outcome = evaluateIcp({"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* const word : {"SCAN_A SCAN_B",
                                 "3 sigma",
                                 "degrees",
                                 "--guess",
                                 "--offset-xy",
                                 "--offset-yaw",
                                 "--steps-yaw",
                                 "--sigma-position",
                                 "brute-force",
                                 "icp_runs.csv",
                                 "quaternion helix small-angle euler"})
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
}
