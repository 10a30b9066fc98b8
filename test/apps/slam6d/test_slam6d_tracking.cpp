// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d --track: the sweeps of a drive without poses, tracked in their order.
#include "apps/support/corridor_run.h"
#include "apps/support/simulated_drive.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/trajectory_io.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace {
namespace fs = std::filesystem;
using pcl6d::distanceBetween;
using pcl6d::readTrajectory;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::runProgram;
using pcl6d::test::simulatedDrive;
using pcl6d::test::slam;
using pcl6d::test::TempFolder;

/** Writes the points of the drive alone, without poses and times. */
fs::path
pointsOfDrive(const TempFolder& folder)
{
  const fs::path points = folder / "points";
  const Outcome outcome = runProgram("pcl_slam6d_convert",
                                     {"scans",
                                      simulatedDrive().string(),
                                      "-o",
                                      points.string(),
                                      "--format",
                                      "xyz",
                                      "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const auto& entry : fs::directory_iterator(fs::path(points)))
    if (entry.path().extension() != ".xyz")
      fs::remove(entry.path());
  return points;
}

nlohmann::json
summaryOfDrive(const fs::path& run)
{
  return nlohmann::json::parse(readText(run / "summary.json"));
}

/** \return [m] the largest distance of a pose from the truth, seen from the first one */
double
largestError(const fs::path& run)
{
  const auto truth = readTrajectory(simulatedDrive() / "groundtruth.txt").poses;
  const auto found = readTrajectory(run / "trajectory.kitti").poses;
  double largest = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    largest = std::max(
        largest,
        distanceBetween(truth[0].inverse() * truth[i], found[0].inverse() * found[i])
            .translation);
  return largest;
}
} // namespace

TEST(TrackedDrive, SweepsAreTrackedAndDeskewed)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  const Outcome outcome =
      slam(simulatedDrive(),
           out,
           {"--track", "--last", "15", "--every", "1", "--no-picture"});
  EXPECT_NE(outcome.err.find("motion during a scan is corrected"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(
      summaryOfDrive(out)["pose_source"],
      "tracking in the order of the files (0 of 16 scans lost), begun with the pose "
      "of odometry.txt");
  EXPECT_LT(largestError(out), 0.06); // half a voxel of 0.12 m
}

TEST(TrackedDrive, LargeFoldersWithoutPosesAreTrackedUnlessNotWanted)
{
  const TempFolder folder;
  const std::vector<std::string> quick = {"--every",
                                          "1",
                                          "--no-verification",
                                          "--recovery",
                                          "off",
                                          "--relaxation",
                                          "none",
                                          "--loop-closing",
                                          "none",
                                          "--no-picture"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), quick.begin(), quick.end());
    return more;
  };
  const fs::path points = pointsOfDrive(folder);
  slam(points, folder / "large", with({}));
  const auto large = summaryOfDrive(folder / "large");
  EXPECT_EQ(large["pose_source"],
            "tracking in the order of the files (0 of 64 scans lost)");
  EXPECT_LT(largestError(folder / "large"),
            0.3); // 9 m of a chain, distorted by the motion
  slam(points, folder / "small", with({"--last", "5", "--initial-guess", "odometry"}));
  EXPECT_EQ(summaryOfDrive(folder / "small")["pose_source"], "identity");
  slam(points,
       folder / "off",
       with({"--track", "off", "--initial-guess", "odometry", "--last", "5"}));
  EXPECT_EQ(summaryOfDrive(folder / "off")["pose_source"], "identity");
}

TEST(TrackedDrive, KeyframesAreTheScansOfTheMapAndAllSweepsHavePoses)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  const Outcome outcome = slam(simulatedDrive(), out, {"--track", "--no-picture"});
  const auto summary = summaryOfDrive(out);
  EXPECT_EQ(summary["drive"]["files"].size(), 64u);
  EXPECT_TRUE(summary["drive"]["lost"].empty());
  EXPECT_NEAR(summary["drive"]["seconds"], 6.3, 1e-9);
  EXPECT_NEAR(summary["drive"]["path_length"], 9.45, 0.3);
  EXPECT_LT(summary["scans"].size(), 16u);
  EXPECT_GT(summary["scans"].size(), 2u);
  EXPECT_NE(outcome.out.find("the scans are the keyframes of 64 sweeps along 9."),
            std::string::npos)
      << outcome.out;
  const auto found = readTrajectory(out / "trajectory.tum");
  ASSERT_EQ(found.poses.size(), 64u);
  EXPECT_NEAR(found.stamps[1] - found.stamps[0], 0.1, 1e-9);
  // 9 m from a first pose that 16 rings leave tilted by half a degree.
  EXPECT_LT(largestError(out), 0.12);
  const Outcome measured =
      runProgram("pcl_slam6d_evaluate",
                 {"trajectory",
                  (out / "trajectory.kitti").string(),
                  (simulatedDrive() / "groundtruth.txt").string()});
  EXPECT_EQ(measured.exit_code, 0) << measured.err;
}

namespace {
/** Links the files of the simulated drive, but for some sweeps, and writes their true poses in
 * another world, and their stamps. \return the given poses */
std::vector<Eigen::Isometry3d>
linkDrive(const fs::path& into, const std::vector<int>& missing)
{
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.linear() = Eigen::AngleAxisd(2, Eigen::Vector3d::UnitZ()).matrix();
  moved.translation() << 300, -200, 10;
  const auto truth = readTrajectory(simulatedDrive() / "groundtruth.txt").poses;
  std::vector<Eigen::Isometry3d> given;
  fs::create_directory(into);
  std::ofstream stamps(into / "times.txt"), rows(into / "odometry.txt");
  for (int i = 0; i < static_cast<int>(truth.size()); ++i) {
    if (std::find(missing.begin(), missing.end(), i) != missing.end())
      continue;
    const std::string name = pcl6d::scanName(i) + ".pcd";
    fs::create_symlink(simulatedDrive() / name, into / name);
    given.push_back(moved * truth[static_cast<std::size_t>(i)]);
    stamps << 0.1 * i << '\n';
    const Eigen::IOFormat row(17, Eigen::DontAlignCols, " ", " ");
    rows << given.back().matrix().topRows<3>().format(row) << '\n';
  }
  return given;
}

/** \return [m] the largest distance of a pose of a run from the given one */
double
largestDistance(const fs::path& run, const std::vector<Eigen::Isometry3d>& given)
{
  const auto found = readTrajectory(run / "trajectory.kitti").poses;
  EXPECT_EQ(found.size(), given.size());
  double largest = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    largest = std::max(largest, distanceBetween(given[i], found[i]).translation);
  return largest;
}
} // namespace

TEST(TrackedDrive, SweepsWithPosesAreTrackedInTheirWorld)
{
  const TempFolder folder;
  const auto given = linkDrive(folder / "in", {30, 31, 32});
  const Outcome outcome = slam(folder / "in", folder / "out", {"--no-picture"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(summaryOfDrive(folder / "out")["drive"]["files"].size(), 61u);
  const auto first = readTrajectory(folder / "out/trajectory.kitti").poses[0];
  EXPECT_LT(distanceBetween(given[0], first).translation, 1e-6);
  EXPECT_LT(largestDistance(folder / "out", given), 0.12); // as without poses
  slam(folder / "in",
       folder / "each",
       {"--start", "poses", "--last", "3", "--no-verification", "--no-picture"});
  EXPECT_EQ(summaryOfDrive(folder / "each")["scans"].size(), 4u);
}

TEST(TrackedDrive, ASweepWithAPoseThatIsLostIsAScanOfTheMap)
{
  const TempFolder folder;
  const auto given = linkDrive(folder / "in", {});
  const fs::path lost = folder / "in/scan030.pcd";
  fs::remove(lost);
  std::ofstream(lost) << "VERSION 0.7\nFIELDS x y z t\nSIZE 4 4 4 4\nTYPE F F F F\n"
                         "COUNT 1 1 1 1\nWIDTH 3\nHEIGHT 1\nPOINTS 3\nDATA ascii\n"
                         "1 0 0 0\n0 1 0 0.05\n0 0 1 0.09\n";
  const Outcome outcome =
      slam(folder / "in", folder / "out", {"--no-picture", "--no-verification"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.out.find("scan030.pcd"), std::string::npos) << outcome.out;
  const auto summary = summaryOfDrive(folder / "out");
  EXPECT_TRUE(summary["drive"]["lost"].empty());
  EXPECT_LT(largestDistance(folder / "out", given), 0.12);
}

TEST(TrackedDrive, AContinuedDriveTakesTheSweepsThatFollow)
{
  const TempFolder folder;
  const fs::path first = folder / "first";
  slam(simulatedDrive(), first, {"--track", "--last", "31", "--no-picture"});
  ASSERT_EQ(summaryOfDrive(first)["drive"]["files"].size(), 32u);
  const std::size_t keyframes = summaryOfDrive(first)["scans"].size();
  const Outcome same = slam(simulatedDrive(),
                            folder / "same",
                            {"--continue", first.string(), "--last", "31"});
  EXPECT_EQ(same.exit_code, 1);
  EXPECT_NE(same.err.find("holds all"), std::string::npos) << same.err;
  slam(simulatedDrive(),
       folder / "more",
       {"--continue", first.string(), "--last", "35", "--no-picture"});
  const auto more = summaryOfDrive(folder / "more");
  ASSERT_EQ(more["scans"].size(), keyframes + 4);
  EXPECT_EQ(more["scans"][keyframes]["file"], "scan032.pcd");
}

TEST(TrackedDrive, ASweepThatCannotBeMatchedIsNamed)
{
  const TempFolder folder;
  const fs::path points = pointsOfDrive(folder);
  std::ofstream(points / "scan030.xyz") << "1 0 0\n0 1 0\n0 0 1\n";
  const Outcome outcome =
      slam(points, folder / "out", {"--track", "--no-picture", "--no-verification"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.out.find("1 sweep could not be matched, and their poses are "
                             "predictions: scan030.xyz"),
            std::string::npos)
      << outcome.out;
  for (const char* words : {"tracking: lost at sweep 30 (scan030.xyz)",
                            "tracking: found again at sweep 31 (scan031.xyz)"})
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
  const auto summary = summaryOfDrive(folder / "out");
  EXPECT_EQ(summary["drive"]["lost"], nlohmann::json::array({30}));
  EXPECT_EQ(summary["pose_source"],
            "tracking in the order of the files (1 of 64 scans lost, first at sweep 30 "
            "(scan030.xyz))");
}

TEST(TrackedDrive, AStartSetsTrackingAndInitialGuess)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  const std::vector<std::string> quick = {
      "--last", "3", "--no-verification", "--no-picture", "--force"};
  const auto optionsOf = [&](const std::string& start) {
    std::vector<std::string> arguments = {"--start", start};
    arguments.insert(arguments.end(), quick.begin(), quick.end());
    slam(simulatedDrive(), out, arguments);
    const auto options = summaryOfDrive(out)["options"];
    return options["initial-guess"]["value"].get<std::string>() + ' ' +
           options["track"]["value"].get<std::string>();
  };
  EXPECT_EQ(optionsOf("poses"), "odometry off");
  EXPECT_EQ(optionsOf("sequence"), "odometry on");
  EXPECT_EQ(optionsOf("overlap"), "overlap off");
  EXPECT_EQ(optionsOf("any-order"), "global off");
  EXPECT_EQ(optionsOf("auto"), "odometry auto");
  const Outcome wrong = slam(simulatedDrive(), out, {"--start", "here"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("auto, poses, sequence, overlap, features or any-order"),
            std::string::npos)
      << wrong.err;
  const Outcome twice =
      slam(simulatedDrive(), out, {"--start", "poses", "--track", "on"});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_NE(twice.err.find("--start sets --track"), std::string::npos) << twice.err;
}

TEST(TrackedDrive, AWordThatIsNoneIsRefused)
{
  const TempFolder folder;
  const Outcome outcome = slam(simulatedDrive(), folder / "out", {"--track=yes"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("auto, on or off"), std::string::npos) << outcome.err;
}
