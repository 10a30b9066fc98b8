// SPDX-License-Identifier: BSD-3-Clause
#include "apps/simulate/simulate_program.h"
#include "apps/support/program_names.h"
#include "support/folders.h"
#include "support/run_program.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/trajectory_io.h>

#include <boost/process.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <set>
#include <thread>

namespace {
namespace bp = boost::process;
namespace fs = std::filesystem;
using pcl6d::test::contentOf;
using pcl6d::test::kSimulate;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::simulate;
using pcl6d::test::TempFolder;

std::set<std::string>
namesIn(const fs::path& folder)
{
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    names.insert(entry.path().filename().string());
  return names;
}

void
expectOneErrorLine(const Outcome& outcome, int exit_code, const std::string& part)
{
  pcl6d::test::expectError(outcome, kSimulate, exit_code, {part});
}
} // namespace

TEST(Simulate, WritesAScanFolder)
{
  const TempFolder folder;
  const fs::path out = folder / "new" / "out";
  const Outcome outcome = simulate({"corridor", "-o", out.string(), "--scans", "3"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("3 scans"), std::string::npos) << outcome.out;
  EXPECT_EQ(namesIn(out),
            (std::set<std::string>{"groundtruth.txt",
                                   "odometry.txt",
                                   "scan000.pcd",
                                   "scan001.pcd",
                                   "scan002.pcd",
                                   "scene.json"}));
  const auto odometry = pcl6d::readTrajectory(out / "odometry.txt");
  const auto truth = pcl6d::readTrajectory(out / "groundtruth.txt");
  ASSERT_EQ(odometry.poses.size(), 3u);
  ASSERT_EQ(truth.poses.size(), 3u);
  const std::string start = "1 0 0 0 0 1 0 0 0 0 1 0\n";
  EXPECT_EQ(readText(out / "odometry.txt").substr(0, start.size()), start);
  EXPECT_EQ(readText(out / "groundtruth.txt").substr(0, start.size()), start);
  EXPECT_GT(truth.poses[1].translation().z(), 0.1); // a third of the way: on the ramp
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(odometry.poses[i].translation().z(), 0);
    const auto viewpoint =
        pcl6d::readPcdViewpoint(out / ("scan00" + std::to_string(i) + ".pcd"));
    const auto error = pcl6d::distanceBetween(viewpoint, odometry.poses[i]);
    EXPECT_LT(error.translation, 1e-12); // 17 digits each
    EXPECT_LT(error.rotation, 1e-12);
  }
}

TEST(Simulate, WritesOrganizedScansWithIntensity)
{
  const TempFolder folder;
  ASSERT_EQ(
      simulate({"corridor", "-o", folder.path().string(), "--scans", "1"}).exit_code,
      0);
  const auto cloud = pcl6d::readPcd(folder / "scan000.pcd");
  EXPECT_EQ(cloud.width, 121u);
  EXPECT_EQ(cloud.height, 360u);
  ASSERT_EQ(cloud.fields.size(), 4u);
  EXPECT_EQ(cloud.fields[3].name, "intensity");
  const pcl6d::ScanFolder scans(folder.path());
  EXPECT_EQ(scans.size(), 1u);
  EXPECT_EQ(scans.poseSource(), "odometry.txt");
}

TEST(Simulate, WritesTheSameBytesForTheSameSeed)
{
  const TempFolder folder;
  const auto bytes = [&](const std::string& name,
                         const std::string& seed,
                         const std::string& threads) {
    const auto out = folder / name;
    const Outcome outcome = simulate({"corridor",
                                      "-o",
                                      out.string(),
                                      "--scans",
                                      "3",
                                      "--quiet",
                                      "--seed",
                                      seed,
                                      "--threads",
                                      threads});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
    return contentOf(out);
  };
  const auto expected = bytes("one", "7", "1");
  EXPECT_TRUE(bytes("two", "7", "2") == expected); // megabytes, not to be printed
  EXPECT_TRUE(bytes("eight", "7", "8") == expected);
  auto other = bytes("other", "8", "1");
  EXPECT_TRUE(other["scan001.pcd"] != expected.at("scan001.pcd"));
  EXPECT_NE(other["odometry.txt"], expected.at("odometry.txt"));
  EXPECT_EQ(other["groundtruth.txt"], expected.at("groundtruth.txt"));
}

TEST(Simulate, EndsAfterTheLastScanWithoutChangingTheScansBefore)
{
  const TempFolder folder;
  const auto files = [&](const std::string& name,
                         const std::vector<std::string>& more) {
    const auto out = folder / name;
    std::vector<std::string> arguments = {
        "campus", "-o", out.string(), "--scans", "300", "--resolution", "8", "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = simulate(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return contentOf(out);
  };
  for (const std::vector<std::string>& moving :
       {std::vector<std::string>{}, {"--traffic", "1"}}) {
    std::vector<std::string> two = moving, four = moving;
    two.insert(two.end(), {"--last", "1"});
    four.insert(four.end(), {"--last", "3"});
    auto of_two = files("two", two), of_four = files("four", four);
    EXPECT_EQ(of_two.count("scan002.pcd"), 0u);
    EXPECT_EQ(of_four.count("scan003.pcd"), 1u);
    EXPECT_EQ(of_four.count("scan004.pcd"), 0u);
    for (const char* scan : {"scan000.pcd", "scan001.pcd"})
      EXPECT_TRUE(of_two[scan] == of_four[scan]) << scan;
    for (const char* poses : {"odometry.txt", "groundtruth.txt"})
      EXPECT_EQ(of_four[poses].rfind(of_two[poses], 0), 0u) << poses;
  }
  EXPECT_EQ(
      simulate({"corridor", "-o", (folder / "x").string(), "--last", "-1"}).exit_code,
      2);
}

TEST(Simulate, ReplacesAnEarlierRunWhole)
{
  const TempFolder folder;
  const std::string out = folder.path().string();
  ASSERT_EQ(simulate({"corridor", "-o", out, "--scans", "4"}).exit_code, 0);
  ASSERT_EQ(simulate({"corridor", "-o", out, "--scans", "2"}).exit_code, 0);
  EXPECT_EQ(pcl6d::ScanFolder(folder.path()).size(), 2u);
}

TEST(Simulate, RefusesForeignFoldersUnlessForced)
{
  const TempFolder folder;
  pcl6d::test::writeText(folder / "scan007.pcd", "not yours");
  pcl6d::test::writeText(folder / "thesis.tex", "not yours either");
  const auto before = contentOf(folder.path());
  const std::string out = folder.path().string();
  expectOneErrorLine(simulate({"corridor", "-o", out, "--scans", "1"}), 1, out);
  EXPECT_EQ(contentOf(folder.path()), before);
  expectOneErrorLine(simulate({"corridor", "-o", out, "--scans", "1", "--force"}),
                     1,
                     "holds measured scans");
  EXPECT_EQ(contentOf(folder.path()), before) << "somebody's scans, even with --force";
  std::filesystem::remove(folder / "scan007.pcd");
  ASSERT_EQ(simulate({"corridor", "-o", out, "--scans", "1", "--force"}).exit_code, 0);
  EXPECT_EQ(pcl6d::ScanFolder(folder.path()).size(), 1u);
  EXPECT_EQ(readText(folder / "thesis.tex"), "not yours either");
}

TEST(Simulate, NamesWhatIsWrongWithTheCommandLine)
{
  const TempFolder folder;
  const std::string out = (folder / "out").string();
  const auto expectUsage = [&](std::vector<std::string> arguments,
                               const std::string& part) {
    arguments.insert(arguments.end(), {"-o", out});
    SCOPED_TRACE(part);
    expectOneErrorLine(simulate(arguments), 2, part);
    EXPECT_FALSE(fs::exists(out));
  };
  expectUsage({"cathedral"}, "known: corridor");
  expectUsage({}, "SCENE");
  expectUsage({"corridor", "--scans", "0"}, "= 0");
  expectUsage({"corridor", "--scans", "many"}, "many");
  expectUsage({"corridor", "--seed", "-1"}, "-1");
  expectUsage({"corridor", "--threads", "-1"}, "-1");
  expectUsage({"corridor", "--noise", "-0.1"}, "-0.1");
  expectUsage({"corridor", "--noise", "nan"}, "nan");
  expectUsage({"corridor", "--scanner", "sonar"}, "sonar");
  expectUsage({"corridor", "--velocity", "3"}, "--velocity");
  expectUsage({"corridor", "--resolution", "0"}, "= 0");
  expectUsage({"corridor", "--resolution", "nan"}, "nan");
  expectUsage({"corridor", "--resolution", "1e-6"}, "GB");
  expectOneErrorLine(simulate({"corridor"}), 2, "output");
}

TEST(Simulate, ScansWithTheScannerOfTheGivenName)
{
  const TempFolder folder;
  const std::string out = folder.path().string();
  const auto scan = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"corridor", "-o", out, "--scans", "1"});
    const Outcome outcome = simulate(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return pcl6d::readPcd(folder / "scan000.pcd");
  };
  const auto lidar = scan({"--scanner", "vlp16"});
  EXPECT_EQ(lidar.height, 16u);
  EXPECT_EQ(lidar.width, 1800u);
  const auto coarse = scan({"--scanner", "vlp16", "--resolution", "1"});
  EXPECT_EQ(coarse.width, 360u);
  // Without errors the seed has no say.
  const auto exact = scan({"--scanner", "tof", "--exact", "--seed", "1"});
  EXPECT_TRUE(scan({"--scanner", "tof", "--exact", "--seed", "2"}).data == exact.data);
  EXPECT_FALSE(scan({"--scanner", "tof", "--seed", "2"}).data == exact.data);
  EXPECT_NE(readText(folder / "scene.json").find("\"scanner\": \"tof\""),
            std::string::npos);
  const std::string help = simulate({"--help"}).out;
  for (const char* name : {"pitching", "rotating", "scandrive", "sick", "vlp16"})
    EXPECT_NE(help.find(name), std::string::npos) << name;
}

TEST(Simulate, NamesAnOutputThatCannotBe)
{
  const TempFolder folder;
  pcl6d::test::writeText(folder / "file", "");
  for (const auto& out : {folder / "file", folder / "file/below"})
    expectOneErrorLine(
        simulate({"corridor", "-o", out.string(), "--scans", "1"}), 1, out.string());
  EXPECT_EQ(namesIn(folder.path()), std::set<std::string>{"file"});
}

TEST(Simulate, LeavesNothingBehindWhenInterrupted)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  bp::child program(PCL6D_BIN_DIR "/pcl_slam6d_simulate",
                    bp::args = {"corridor", "-o", out.string(), "--scans", "100000"},
                    bp::std_out > bp::null,
                    bp::std_err > bp::null);
  while (program.running() && !fs::exists(out))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  std::this_thread::sleep_for(std::chrono::milliseconds(200)); // some scans
  ::kill(program.id(), SIGINT);
  program.wait();
  EXPECT_EQ(program.exit_code(), 130);
  EXPECT_TRUE(fs::is_empty(folder.path())) << "nor beside it";
}
