// SPDX-License-Identifier: BSD-3-Clause
#include "io/io_test.h"
#include "support/temp_folder.h"

#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_summary.h>

#include <pcl/conversions.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <limits>

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using pcl6d::IoFailed;
using pcl6d::readRunSummary;
using pcl6d::RunResult;
using pcl6d::ScanFolder;
using pcl6d::test::messageOf;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;

namespace {
Eigen::Isometry3d
at(double x)
{
  Eigen::Isometry3d pose(Eigen::Translation3d(x, 1.0 / 3, -1e-17));
  pose.rotate(Eigen::AngleAxisd(0.1 * x, Eigen::Vector3d(1, 2, 2) / 3));
  return pose;
}

/** A summary in which every field differs from its default. */
RunResult
summaryOf(std::size_t scans)
{
  RunResult summary;
  summary.generator = "pcl_slam6d";
  summary.version = "9.9";
  summary.world_offset = {1e5, -2e5, 3};
  summary.pose_source = "odometry.txt";
  summary.moved = {pcl6d::PoseReading::kScanner, {512345, -7, 1}};
  summary.options = {{"voxel", "0.1", "derived", "because"},
                     {"seed", "7", "given", ""}};
  summary.stages = {{"reading", 0.1, 12.5}, {"matching", 1.0 / 7, 13}};
  for (std::size_t i = 0; i < scans; ++i) {
    pcl6d::ScanResult scan;
    scan.file = "säule \"" + std::to_string(i) + "\".pcd";
    scan.index = static_cast<int>(2 * i);
    scan.initial_pose = at(static_cast<double>(i));
    scan.T_world_scan = at(1.5 * static_cast<double>(i));
    if (i > 0) {
      const Eigen::Matrix<double, 6, 6> factor = Eigen::Matrix<double, 6, 6>::Random();
      scan.covariance = factor.transpose() * factor;
    }
    scan.state = i == 0 ? pcl6d::ScanState::kFixed : pcl6d::ScanState::kMatched;
    scan.status = pcl6d::Status::kOk;
    scan.start = pcl6d::InitialGuess::kOverlap;
    scan.points = 100 + i;
    scan.dropped = i;
    scan.reduced = 50;
    scan.pairs = 40;
    scan.rms = 0.1 / 3;
    scan.overlap = 0.8;
    scan.iterations = 12;
    scan.correction = 1e-3 / 3;
    if (i == 2) {
      scan.rejections = {{pcl6d::RejectReason::kOverlapTooSmall, 0.08, 0.1},
                         {pcl6d::RejectReason::kNoPoseInMap,
                          {pcl6d::RejectReason::kSecondPose, 0.9, 0.8}},
                         {pcl6d::RejectReason::kIcpFailed, pcl6d::Status::kDiverged}};
      scan.rejections[0].deviations = 4.5;
      scan.rejections[0].text = "säule";
    }
    if (i == 1) // not looked for in others
      scan.motion = {true, pcl6d::Rejection::stated("why not"), 0.1, 0.05, 0.02, 3, {}};
    summary.scans.push_back(scan);
  }
  summary.graph_stages = {{pcl6d::StageKind::kRelaxation,
                           true,
                           pcl6d::RejectReason::kNoCycle,
                           0.1,
                           0.2,
                           3,
                           0.5,
                           {}}};
  summary.links_used = 5;
  summary.links_refused = 2;
  summary.floating = {"b.pcd"};
  summary.map_points = 77;
  summary.trusted = false;
  summary.warnings = {"one", "two"};
  summary.verdict = "two\nlines";
  return summary;
}

/** \return a run folder with its scans, at stamps that are no indices */
RunResult
writeRun(const fs::path& run, std::size_t scans, double first_stamp)
{
  const RunResult summary = summaryOf(scans);
  fs::create_directories(run / "scans");
  pcl6d::Trajectory trajectory;
  pcl::PointCloud<pcl::PointXYZ> points;
  points.push_back({1, 2, 3});
  pcl::PCLPointCloud2 cloud;
  pcl::toPCLPointCloud2(points, cloud);
  for (const auto& scan : summary.scans) {
    pcl6d::writePcd(run / "scans" / (pcl6d::scanName(scan.index) + ".pcd"),
                    cloud,
                    scan.T_world_scan);
    trajectory.poses.push_back(scan.T_world_scan);
    trajectory.stamps.push_back(first_stamp + scan.index);
  }
  pcl6d::writeTrajectoryTum(run / "trajectory.tum", trajectory);
  return summary;
}

/** A folder of scans of these names. */
void
writeScans(const fs::path& folder, const std::vector<std::string>& names)
{
  fs::create_directories(folder);
  for (const auto& name : names)
    std::ofstream(folder / name) << "0 0 0\n";
}
} // namespace

TEST(RunResult, ComesBackAsItWas)
{
  const TempFolder folder;
  const RunResult summary = summaryOf(3);
  pcl6d::writeRunSummary(folder / "a.json", summary);
  const RunResult back = readRunSummary(folder / "a.json");
  pcl6d::writeRunSummary(folder / "b.json", back);
  EXPECT_EQ(readText(folder / "a.json"), readText(folder / "b.json"));
  ASSERT_EQ(back.scans.size(), 3u);
  EXPECT_EQ(back.scans[2].T_world_scan.matrix(),
            summary.scans[2].T_world_scan.matrix());
  EXPECT_EQ(back.scans[2].initial_pose.matrix(),
            summary.scans[2].initial_pose.matrix());
  EXPECT_EQ(*back.scans[1].covariance, *summary.scans[1].covariance);
  EXPECT_FALSE(back.scans[0].covariance);
  EXPECT_EQ(back.options[0].why, "because");
  EXPECT_EQ(back.graph_stages[0].rounds, 3);
  EXPECT_EQ(back.graph_stages[0].rejection.reason, pcl6d::RejectReason::kNoCycle);
  EXPECT_EQ(back.scans[2].rejections, summary.scans[2].rejections);
  EXPECT_TRUE(back.scans[0].rejections.empty());
}

TEST(RunResult, OfAnEarlierVersionHasItsReasonsInWords)
{
  const TempFolder folder;
  RunResult summary = summaryOf(1);
  summary.scans[0].rejections = {pcl6d::Rejection::stated("overlap 0.1")};
  summary.graph_stages.clear();
  pcl6d::writeRunSummary(folder / "new.json", summary);
  auto json = Json::parse(readText(folder / "new.json"));
  json["scans"][0].erase("rejections");
  std::ofstream(folder / "old.json") << json;
  EXPECT_EQ(readRunSummary(folder / "old.json").scans[0].rejections,
            summary.scans[0].rejections);
}

TEST(RunResult, RefusesRejectionsThatNoRunWrote)
{
  const TempFolder folder;
  RunResult summary = summaryOf(1);
  summary.scans[0].rejections = {{pcl6d::RejectReason::kTooFewPairs, 2, 3}};
  pcl6d::writeRunSummary(folder / "run.json", summary);
  const auto json = Json::parse(readText(folder / "run.json"));
  const auto expectRefused = [&](const Json& rejections) {
    Json broken = json;
    broken["scans"][0]["rejections"] = rejections;
    std::ofstream(folder / "broken.json") << broken;
    EXPECT_THROW(readRunSummary(folder / "broken.json"), pcl6d::IoFailed) << rejections;
  };
  expectRefused("few pairs");
  expectRefused(Json::array({{{"reason", "bad luck"}}}));
  expectRefused(Json::array({{{"measured", 2}}}));
  expectRefused(Json::array({{{"reason", "icp-failed"}, {"status", "asleep"}}}));
  Json deep{{"reason", "stated"}};
  for (int k = 0; k < 20; ++k)
    deep = {{"reason", "stated"}, {"cause", deep}};
  expectRefused(Json::array({deep}));
}

TEST(RunResult, NumbersThatAreNotFiniteComeBackAsNoNumber)
{
  const TempFolder folder;
  RunResult summary = summaryOf(1);
  summary.scans[0].rms = std::numeric_limits<double>::infinity();
  pcl6d::writeRunSummary(folder / "a.json", summary);
  EXPECT_TRUE(std::isnan(readRunSummary(folder / "a.json").scans[0].rms));
}

TEST(RunResult, ADriveHoldsItsKeyframesAndComesBack)
{
  const TempFolder folder;
  RunResult summary = summaryOf(3); // indices 0, 2, 4
  summary.drive.emplace();
  summary.drive->files = {"a", "b", "c", "d", "e"};
  summary.drive->lost = {1, 3};
  summary.drive->way = 12.5;
  summary.drive->seconds = 1.0 / 3;
  pcl6d::writeRunSummary(folder / "a.json", summary);
  const auto back = readRunSummary(folder / "a.json").drive;
  ASSERT_TRUE(back);
  EXPECT_EQ(back->first, 0);
  EXPECT_EQ(back->files, summary.drive->files);
  EXPECT_EQ(back->lost, summary.drive->lost);
  EXPECT_EQ(back->way, 12.5);
  EXPECT_EQ(back->seconds, 1.0 / 3);
  const auto errorOf = [&](const RunResult& run) {
    pcl6d::writeRunSummary(folder / "b.json", run);
    return messageOf<IoFailed>([&] { readRunSummary(folder / "b.json"); });
  };
  RunResult broken = summary;
  broken.drive->files.pop_back();
  EXPECT_NE(errorOf(broken).find("/drive/files"), std::string::npos) << errorOf(broken);
  broken = summary;
  broken.drive->lost = {7};
  EXPECT_NE(errorOf(broken).find("/drive/lost/0: 7"), std::string::npos)
      << errorOf(broken);
}

TEST(RunResult, BrokenFilesAreNamedWithWhatIsWrong)
{
  const TempFolder folder;
  const fs::path file = folder / "summary.json";
  pcl6d::writeRunSummary(file, summaryOf(2));
  const std::string good = readText(file);
  const auto errorOf = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    EXPECT_NE(text.find(from), std::string::npos) << from;
    text.replace(text.find(from), from.size(), to);
    std::ofstream(file) << text;
    const std::string error = messageOf<IoFailed>([&] { readRunSummary(file); });
    EXPECT_EQ(error.find(file.string()), 0u) << error;
    return error;
  };
  const auto expect = [](const std::string& error, const std::string& part) {
    EXPECT_NE(error.find(part), std::string::npos) << error;
  };
  expect(errorOf("\"schema_version\": 2", "\"schema_version\": 3"),
         "/schema_version: 3, but must be 1 to 2");
  expect(errorOf("{", "["), "line 2: not the syntax of JSON");
  expect(errorOf("\"T_world_scan\"", "\"pose\""), "key 'T_world_scan' is missing");
  expect(errorOf("\"version\":", "\"version\""), "line 4: not the syntax of JSON");
  expect(errorOf("\"T_world_scan\": [", "\"T_world_scan\": [1,"),
         "/scans/0/T_world_scan: expected 16 numbers, got 17");
  expect(errorOf("\"points\": 100", "\"points\": \"x\""),
         "/scans/0/points: \"x\" is not a whole number >= 0");
  expect(messageOf<IoFailed>([&] { readRunSummary(folder / "none.json"); }), "No such");
}

TEST(ContinuedFolder, HoldsTheScansOfTheRunThenTheFurtherOnes)
{
  const TempFolder folder;
  const RunResult summary = writeRun(folder / "run", 2, 0);
  writeScans(folder / "scans", {"c.xyz", "d.xyz"});
  ScanFolder scans(folder / "scans");
  EXPECT_EQ(scans.numRegistered(), 0u);
  scans.continueRun(folder / "run", summary);
  ASSERT_EQ(scans.size(), 4u);
  EXPECT_EQ(scans.numRegistered(), 2u);
  EXPECT_EQ(scans.name(1), summary.scans[1].file);
  EXPECT_EQ(scans.file(1), folder / "run" / "scans" / "scan002.pcd");
  EXPECT_EQ(scans.initialPose(1).matrix(), summary.scans[1].initial_pose.matrix());
  EXPECT_EQ(scans.read(1).points.size(), 1u) << "PCD among xyz";
  EXPECT_EQ(scans.name(2), "c.xyz");
  EXPECT_EQ(scans.read(3).points.size(), 1u);
  for (const auto& [i, index] : {std::pair(0, 0), {1, 2}, {2, 3}, {3, 4}})
    EXPECT_EQ(scans.index(static_cast<std::size_t>(i)), index);
  EXPECT_TRUE(scans.stamps().empty());
}

TEST(ContinuedFolder, LeavesOutWhatTheRunHolds)
{
  const TempFolder folder;
  const RunResult summary = writeRun(folder / "run", 2, 0);
  writeScans(folder / "scans", {"a.xyz", "b.xyz"});
  RunResult known = summary;
  known.scans[0].file = "a.xyz";
  ScanFolder scans(folder / "scans");
  scans.continueRun(folder / "run", known);
  ASSERT_EQ(scans.size(), 3u);
  EXPECT_EQ(scans.name(2), "b.xyz");
  known.scans[1].file = "b.xyz";
  ScanFolder again(folder / "scans");
  EXPECT_NE(messageOf<IoFailed>([&] {
              again.continueRun(folder / "run", known);
            }).find("holds all 2 scans of the folder already"),
            std::string::npos);
}

TEST(ContinuedFolder, KeepsStampsOnlyIfBothHaveThem)
{
  const TempFolder folder;
  const RunResult summary = writeRun(folder / "run", 2, 1000.5);
  writeScans(folder / "scans", {"a.xyz"});
  ScanFolder without(folder / "scans");
  without.continueRun(folder / "run", summary);
  EXPECT_TRUE(without.stamps().empty());
  std::ofstream(folder / "poses.tum") << "2000.25 0 0 0 0 0 0 1\n";
  pcl6d::ScanFolderOptions options;
  options.poses_file = folder / "poses.tum";
  ScanFolder with(folder / "scans", options);
  with.continueRun(folder / "run", summary);
  EXPECT_EQ(with.stamps(), (std::vector<double>{1000.5, 1002.5, 2000.25}));
}

TEST(ContinuedFolder, LeavesOutTheSweepsBetweenKeyframes)
{
  const TempFolder folder;
  RunResult summary = writeRun(folder / "run", 2, 1000.5); // indices 0 and 2
  summary.scans[0].file = "a.xyz";
  summary.scans[1].file = "c.xyz";
  summary.drive.emplace();
  summary.drive->files = {"a.xyz", "b.xyz", "c.xyz", "d.xyz"};
  std::string rows;
  for (const char* const stamp : {"0.5", "1.5", "2.5", "3.5"})
    rows += std::string(stamp) + " 0 0 0 0 0 0 1\n";
  std::ofstream(folder / "run" / "trajectory.tum") << rows;
  EXPECT_EQ(pcl6d::stampsOfRun(folder / "run", summary),
            (std::vector<double>{0.5, 2.5}));
  writeScans(folder / "scans", {"a.xyz", "b.xyz", "c.xyz", "d.xyz", "e.xyz"});
  ScanFolder scans(folder / "scans");
  scans.continueRun(folder / "run", summary);
  ASSERT_EQ(scans.size(), 3u);
  EXPECT_EQ(scans.name(2), "e.xyz");
  EXPECT_EQ(scans.index(2), 4);
}

TEST(ContinuedFolder, NamesWhatTheRunLacks)
{
  const TempFolder folder;
  const RunResult summary = writeRun(folder / "run", 2, 0);
  writeScans(folder / "scans", {"a.xyz"});
  ScanFolder scans(folder / "scans");
  const auto error = [&] {
    return messageOf<IoFailed>([&] { scans.continueRun(folder / "run", summary); });
  };
  std::ofstream(folder / "run" / "trajectory.tum") << "0 0 0 0 0 0 0 1\n";
  EXPECT_NE(error().find("trajectory.tum: holds 1 pose for 2 scans"), std::string::npos)
      << error();
  fs::remove(folder / "run" / "scans" / "scan002.pcd");
  EXPECT_NE(error().find("scan002.pcd: is missing"), std::string::npos) << error();
  EXPECT_EQ(scans.size(), 1u) << "as it was";
}
