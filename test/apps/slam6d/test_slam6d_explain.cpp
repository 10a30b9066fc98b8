// SPDX-License-Identifier: BSD-3-Clause
#include "apps/support/corridor_run.h"
#include "apps/support/drive_folder.h"

#include <gtest/gtest.h>

namespace {
using namespace pcl6d::test;
namespace fs = std::filesystem;

bool
tells(const Outcome& outcome, const std::string& words)
{
  return outcome.out.find(words) != std::string::npos;
}

TEST(Slam6dExplain, TellsThePlanAndWritesNothing)
{
  const TempFolder folder;
  const Outcome outcome = runProgram(
      "pcl_slam6d",
      {scans().string(), "--explain", "-o", (folder / "out").string(), "--last", "11"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* words : {"12 scans, initial poses from odometry.txt",
                            "order: scan000.pcd, scan001.pcd, ",
                            ", ... scan011.pcd",
                            "voxel = ",
                            "expected, from the first 4 scans (",
                            " MB to read and register 12 scans",
                            "nothing was written"})
    EXPECT_TRUE(tells(outcome, words)) << words << '\n' << outcome.out;
  EXPECT_FALSE(tells(outcome, "loop-distance")); // follows from all poses
  EXPECT_TRUE(fs::is_empty(folder / ""));
}

TEST(Slam6dExplain, NeedsNoOutputAndTakesTheOptionsOfTheRun)
{
  const Outcome outcome =
      runProgram("pcl_slam6d", {scans().string(), "--explain", "--voxel", "0.23"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(tells(outcome, "voxel = 0.23 m")) << outcome.out;
  expectError(runProgram("pcl_slam6d", {scans().string()}),
              "pcl_slam6d",
              2,
              {"-o OUT_DIR is missing"});
}

TEST(Slam6dExplain, TellsWhatARunWouldRefuse)
{
  const TempFolder folder;
  expectError(runProgram("pcl_slam6d", {(folder / "none").string(), "--explain"}),
              "pcl_slam6d",
              1,
              {"none"});
  expectError(
      runProgram("pcl_slam6d", {scans().string(), "--continue", "run", "--explain"}),
      "pcl_slam6d",
      1,
      {"run"});
}

// The time of an order that holds, and of every pair of scans: a single range.
TEST(Slam6dExplain, TellsOneRangeOfTimesForManyScansWithoutPoses)
{
  const TempFolder folder;
  DriveFolder many(folder / "in");
  for (int i = 0; i < 120; ++i)
    many.add(flatScans(), i % 60, std::to_string(1000 + i) + ".pcd");
  const auto explained = [&](const std::string& start) {
    const Outcome outcome = runProgram("pcl_slam6d",
                                       {many.path().string(),
                                        "--explain",
                                        "--track",
                                        "off",
                                        "--initial-guess",
                                        start});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_FALSE(tells(outcome, "are compared, in about")) << outcome.out;
    return outcome;
  };
  EXPECT_TRUE(tells(explained("global"), "expected, from the first 4 scans ("));
  const Outcome plain =
      runProgram("pcl_slam6d", {many.path().string(), "--explain", "--track", "off"});
  EXPECT_FALSE(tells(plain, "are compared, in about")) << plain.out;
  EXPECT_TRUE(tells(plain, " (in the order of the files) to ")) << plain.out;
  EXPECT_TRUE(tells(plain, " (if all pairs of scans must be compared) and "))
      << plain.out;
}
} // namespace
