// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d on scans of a 2D scanner: known as such, registered in their plane.
#include "apps/support/corridor_run.h"

#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/trajectory_io.h>

#include <nlohmann/json.hpp>

namespace {
namespace fs = std::filesystem;
using pcl6d::readTrajectory;
using pcl6d::Trajectory;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::sharedOutput;
using pcl6d::test::slam;
using pcl6d::test::TempFolder;

/** A way between shelves, 1.5 m from scan to scan. */
const fs::path&
planarScans()
{
  static const fs::path path = sharedOutput("pcl_slam6d_simulate",
                                            {"shelves",
                                             "--scanner",
                                             "sick",
                                             "--resolution",
                                             "0.5",
                                             "--scans",
                                             "60",
                                             "--quiet"});
  return path;
}

const std::vector<std::string> kFew = {"--last", "11", "--no-picture"};

nlohmann::json
summaryOf(const fs::path& run)
{
  return nlohmann::json::parse(readText(run / "summary.json"));
}

/** Copies the scans, with heights [m] in their initial poses. */
void
copyWithHeights(const fs::path& to, double (*heightOf)(std::size_t))
{
  fs::copy(planarScans(), to);
  Trajectory odometry = readTrajectory(to / "odometry.txt");
  for (std::size_t i = 0; i < odometry.poses.size(); ++i)
    odometry.poses[i].translation().z() = heightOf(i);
  fs::remove(to / "odometry.txt");
  pcl6d::writeTrajectoryKitti(to / "odometry.txt", odometry);
}
} // namespace

TEST(PlanarScans, AreRegisteredInTheirPlane)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  const Outcome outcome = slam(planarScans(), out, kFew);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.err.find("planar-rows = "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("2D scans"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("all 12 scans registered"), std::string::npos)
      << outcome.out;
  const Trajectory poses = readTrajectory(out / "trajectory.kitti");
  const Trajectory truth = readTrajectory(planarScans() / "groundtruth.txt");
  ASSERT_EQ(poses.poses.size(), 12U);
  for (std::size_t i = 0; i < poses.poses.size(); ++i) {
    EXPECT_LT((poses.poses[i].translation() - truth.poses[i].translation()).norm(),
              0.03) // measured up to 0.01
        << i;
    EXPECT_EQ(poses.poses[i].translation().z(), 0) << i;
    EXPECT_EQ(poses.poses[i].linear()(2, 2), 1) << i;
  }
}

TEST(PlanarScans, TheMapHasTheMeasuredPointsAlone)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  ASSERT_EQ(slam(planarScans(), out, kFew).exit_code, 0);
  const pcl6d::Points map = pcl6d::readScan(out / "map.pcd").points;
  EXPECT_GT(map.size(), 100U);
  for (const auto& p : map)
    EXPECT_EQ(p.z(), 0);
}

TEST(PlanarScans, AsTheyAreTheyLeaveTheHeightOpen)
{
  const TempFolder folder;
  std::vector<std::string> options = kFew;
  options.insert(options.end(), {"--planar-rows", "0", "--no-recovery"});
  const Outcome outcome = slam(planarScans(), folder / "out", options);
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  const auto bad =
      slam(planarScans(), folder / "bad", {"--planar-rows", "-1", "--no-picture"});
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_NE(bad.err.find("--planar-rows = -1"), std::string::npos) << bad.err;
}

TEST(PlanarScans, PosesThatLeaveThePlaneAreKept)
{
  const TempFolder folder;
  const fs::path in = folder / "in";
  copyWithHeights(in, [](std::size_t i) { return 0.5 * static_cast<double>(i); });
  const Outcome outcome = slam(in, folder / "out", kFew);
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  EXPECT_EQ(outcome.err.find("planar-rows"), std::string::npos) << outcome.err;
  const auto poses = readTrajectory(folder / "out" / "trajectory.kitti").poses;
  EXPECT_NEAR(poses.back().translation().z(), 5.5, 0.5);
}

TEST(PlanarScans, WithoutRelaxationTheyKeepToThePlaneToo)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  std::vector<std::string> options = kFew;
  options.insert(options.end(), {"--loop-closing", "none", "--relaxation", "none"});
  slam(planarScans(), out, options);
  for (const auto& pose : readTrajectory(out / "trajectory.kitti").poses)
    EXPECT_EQ(pose.translation().z(), 0);
}

TEST(PlanarScans, ALiftBehindTheFirstScansIsNotPressedIntoThePlane)
{
  const TempFolder folder;
  const fs::path in = folder / "in";
  copyWithHeights(in, [](std::size_t i) { return i < 18 ? 0.0 : 5.0; });
  const Outcome outcome =
      slam(in, folder / "out", {"--last", "20", "--no-picture", "--no-recovery"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
  const auto poses = readTrajectory(folder / "out" / "trajectory.kitti").poses;
  EXPECT_EQ(poses[17].translation().z(), 0);
  EXPECT_NEAR(poses.back().translation().z(), 5, 0.5);
}

TEST(PlanarScans, TheSummaryHasTheRowsAndGivingThemIsTheSameRun)
{
  const TempFolder folder;
  ASSERT_EQ(slam(planarScans(), folder / "auto", kFew).exit_code, 0);
  const auto options = summaryOf(folder / "auto")["options"];
  std::vector<std::string> given = kFew;
  given.insert(given.end(), {"--planar-rows", options["planar-rows"]["value"]});
  ASSERT_EQ(slam(planarScans(), folder / "given", given).exit_code, 0);
  EXPECT_EQ(readText(folder / "auto" / "trajectory.kitti"),
            readText(folder / "given" / "trajectory.kitti"));
}
