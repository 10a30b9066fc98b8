// SPDX-License-Identifier: BSD-3-Clause
// Folders whose order, names or poses are wrong: the map is right, or the verdict names the scans.
#include "apps/support/corridor_run.h"
#include "apps/support/drive_folder.h"
#include "support/room.h"

#include <chrono>
#include <fstream>

namespace {
namespace fs = std::filesystem;
using namespace pcl6d::test;

/** [m] twice the errors of these coarse scans, far below those of a wrong place */
constexpr double kRight = 0.1;

std::string
numbered(const std::string& start, int i)
{
  return start + std::to_string(100 + i) + ".pcd";
}

nlohmann::json
summaryIn(const fs::path& run)
{
  return nlohmann::json::parse(readText(run / "summary.json"));
}

/** Expects a reliable map with all scans in place, or a verdict with its doubts. */
void
expectRightOrNamed(const Outcome& outcome,
                   const fs::path& run,
                   const DriveFolder& scans)
{
  const std::string verdict = summaryIn(run)["verdict"]["text"];
  if (outcome.exit_code == 0)
    EXPECT_LT(scans.largestError(run), kRight) << verdict;
  else {
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_NE(verdict.find("NOT TO BE TRUSTED"), std::string::npos) << verdict;
  }
}
} // namespace

TEST(BadDrives, NamesWithoutNumbersAndOrder)
{
  const TempFolder folder;
  DriveFolder scans(folder / "in");
  scans.add(flatScans(), 0, "kitchen.pcd");
  scans.add(flatScans(), 2, "bath.pcd");
  scans.add(flatScans(), 4, "hall.pcd");
  scans.add(flatScans(), 6, "living.pcd");
  const Outcome outcome = slam(scans.path(), folder / "out", {"--no-picture"});
  expectRightOrNamed(outcome, folder / "out", scans);
  EXPECT_EQ(summaryIn(folder / "out")["scans"][0]["file"], "bath.pcd");
}

TEST(BadDrives, ScansOfTwoSitesAreNotJoined)
{
  const TempFolder folder;
  DriveFolder scans(folder / "in");
  for (int i = 0; i < 2; ++i) {
    scans.add(flatScans(), i, numbered("a", i));
    scans.add(simulatedDrive(), 20 * i, numbered("b", i));
  }
  const Outcome outcome = slam(scans.path(), folder / "out", {"--no-picture"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  const std::string verdict = summaryIn(folder / "out")["verdict"]["text"];
  EXPECT_NE(verdict.find("100.pcd"), std::string::npos) << verdict;
}

TEST(BadDrives, AGapOfTenSweeps)
{
  const TempFolder folder;
  DriveFolder scans(folder / "in");
  for (int i = 0; i < 50; ++i)
    if (i < 20 || i >= 30)
      scans.add(simulatedDrive(), i, numbered("", i));
  const Outcome outcome =
      slam(scans.path(), folder / "out", {"--track", "--no-picture"});
  expectRightOrNamed(outcome, folder / "out", scans);
}

TEST(BadDrives, TwentyCopiesOfAScan)
{
  const TempFolder folder;
  DriveFolder scans(folder / "in");
  for (int i = 0; i < 20; ++i)
    scans.add(flatScans(), 3, numbered("parked", i));
  const Outcome outcome = slam(scans.path(), folder / "out", {"--no-picture"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_LT(scans.largestError(folder / "out"), 1e-3);
}

TEST(BadDrives, TwentyScansFromOnePosition)
{
  const TempFolder folder;
  fs::create_directory(folder / "in");
  pcl6d::Random random(5);
  const PillarRoom room;
  for (int i = 0; i < 20; ++i) {
    std::ofstream file(folder / ("in/parked" + std::to_string(i) + ".xyz"));
    for (const auto& p : room.scan(Eigen::Isometry3d::Identity(), random, 0.06, 0.01))
      file << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
  }
  const Outcome outcome = slam(folder / "in", folder / "out", {"--no-picture"});
  // A coarse room fits itself turned by half a turn: the verdict may doubt the right map.
  const std::string verdict = summaryIn(folder / "out")["verdict"]["text"];
  EXPECT_TRUE(outcome.exit_code == 0 || verdict.find("AMBIGUOUS") != std::string::npos)
      << verdict;
  for (const auto& pose : pcl6d::readTrajectory(folder / "out/trajectory.kitti").poses)
    EXPECT_LT(pose.translation().norm(), 0.02);
}

TEST(BadDrives, AConstantViewpointIsNoPose)
{
  for (const std::string viewpoint : {"0 0 0 0 0 0 1", "3 4 5 1 0 0 0"}) {
    SCOPED_TRACE(viewpoint);
    const TempFolder folder;
    DriveFolder scans(folder / "in");
    for (int i = 0; i < 4; ++i)
      scans.add(flatScans(), i, numbered("scan", i), viewpoint);
    const Outcome outcome = slam(scans.path(), folder / "out", {"--no-picture"});
    expectRightOrNamed(outcome, folder / "out", scans);
    EXPECT_NE(outcome.err.find("warning: the initial poses (PCD VIEWPOINT) are all "
                               "equal, and count as missing"),
              std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("warning: start in the order of the files"),
              std::string::npos)
        << outcome.err;
    const auto scan = summaryIn(folder / "out")["scans"][0];
    EXPECT_EQ(scan["T_world_scan"], scan["initial_pose"]);
  }
}

TEST(BadDrives, PosesOfAnotherDrive)
{
  const TempFolder folder;
  DriveFolder scans(folder / "in");
  std::string rows;
  for (int i = 0; i < 4; ++i) {
    scans.add(flatScans(), i, numbered("scan", i));
    rows += "1 0 0 " + std::to_string(30 * i) + " 0 1 0 " + std::to_string(-7 * i) +
            " 0 0 1 0\n";
  }
  writeText(folder / "other.txt", rows);
  const Outcome outcome =
      slam(scans.path(),
           folder / "out",
           {"--poses", (folder / "other.txt").string(), "--no-picture"});
  expectRightOrNamed(outcome, folder / "out", scans);
}

TEST(BadDrives, TenThousandFilesAreListedAtOnce)
{
  const TempFolder folder;
  fs::create_directory(folder / "in");
  for (int i = 0; i < 10000; ++i)
    writeText(folder / ("in/s" + std::to_string(i) + ".xyz"),
              "1 0 0\n0 1 0\n0 0 1\n1 1 " + std::to_string(i % 7) + "\n");
  const auto begin = std::chrono::steady_clock::now();
  const Outcome outcome = runProgram(
      "pcl_slam6d", {(folder / "in").string(), "--explain", "--start", "poses"});
  const std::chrono::duration<double> seconds =
      std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("10000 scans"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("order: s0.xyz, s1.xyz, s2.xyz"), std::string::npos)
      << outcome.out;
  EXPECT_LT(seconds.count(),
            10); // half a second, but for sanitizers and loaded machines
}
