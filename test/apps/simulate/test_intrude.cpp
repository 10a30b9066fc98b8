// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_simulate intrude: people and cars in recorded scans.
#include "apps/support/program_names.h"
#include "support/run_program.h"

#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/trajectory_io.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using pcl6d::test::contentOf;
using pcl6d::test::expectError;
using pcl6d::test::kSimulate;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

Outcome
run(const std::vector<std::string>& arguments)
{
  return pcl6d::test::runProgram(kSimulate, arguments);
}

// "Recorded" scans: 6 of a drive on a square, without labels, with exact poses.
class Intrude : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    scans_ = std::make_unique<TempFolder>();
    ASSERT_EQ(run({"crowd",
                   "--without",
                   "person",
                   "--without",
                   "car",
                   "--labels",
                   "no",
                   "--scans",
                   "6",
                   "--resolution",
                   "1.5",
                   "--odometry",
                   "exact",
                   "-o",
                   scans_->path().string()})
                  .exit_code,
              0);
    fs::remove(*scans_ / "scene.json"); // as a recording has none
  }
  static void
  TearDownTestSuite()
  {
    scans_.reset();
  }

  static Outcome
  intrude(const fs::path& out, const std::vector<std::string>& more)
  {
    std::vector<std::string> arguments = {
        "intrude", scans_->path().string(), "-o", out.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }

  static std::unique_ptr<TempFolder> scans_;
  const TempFolder folder_;
};
std::unique_ptr<TempFolder> Intrude::scans_;

std::string
scanFile(int i)
{
  return "scan00" + std::to_string(i) + ".pcd";
}
} // namespace

TEST_F(Intrude, OtherPointsKeepTheirBitsAndMovedOnesTheirRay)
{
  const Outcome outcome = intrude(folder_ / "out", {"--people", "3", "--cars", "1"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::size_t moved = 0;
  for (int i = 0; i < 6; ++i) {
    const auto before = pcl6d::readScan(*scans_ / scanFile(i)); // finite points only
    const auto now = pcl6d::readPcd(folder_ / "out" / scanFile(i));
    const auto points = pcl6d::coordinatesOf(now);
    const auto dynamic = pcl6d::fieldValues(now, "dynamic");
    ASSERT_TRUE(dynamic && dynamic->is_integer);
    ASSERT_EQ(points.size(), before.points.size());
    ASSERT_EQ(now.point_step, before.cloud.point_step + 4);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const std::uint8_t* const is = &now.data[k * now.point_step];
      const std::uint8_t* const was = &before.cloud.data[k * before.cloud.point_step];
      if (dynamic->values[k] == 0) {
        ASSERT_EQ(std::memcmp(is, was, before.cloud.point_step), 0) << i << ' ' << k;
        continue;
      }
      ++moved;
      EXPECT_LT(points[k].norm(), before.points[k].norm());
      EXPECT_LT(points[k].normalized().cross(before.points[k].normalized()).norm(),
                1e-5);
    }
  }
  EXPECT_GT(moved, 200u);
  EXPECT_NE(outcome.out.find(std::to_string(moved) + " of them"), std::string::npos)
      << outcome.out;
}

TEST_F(Intrude, KeepsInitialPosesAndTruthAndTellsWhoWalksWhere)
{
  ASSERT_EQ(intrude(folder_ / "out", {"--people", "2", "--period", "3"}).exit_code, 0);
  const pcl6d::ScanFolder before(scans_->path());
  const pcl6d::ScanFolder now(folder_ / "out");
  ASSERT_EQ(now.size(), before.size());
  EXPECT_EQ(now.poseSource(), "odometry.txt");
  for (std::size_t i = 0; i < now.size(); ++i) {
    EXPECT_TRUE(now.initialPose(i).isApprox(before.initialPose(i), 1e-15));
    EXPECT_EQ(now.stamps().at(i), 3.0 * static_cast<double>(i));
    EXPECT_TRUE(
        pcl6d::readPcdViewpoint(now.file(i)).isApprox(now.initialPose(i), 1e-12));
  }
  EXPECT_EQ(readText(folder_ / "out/groundtruth.txt"),
            readText(*scans_ / "groundtruth.txt"));
  const json scene = json::parse(readText(folder_ / "out/scene.json"));
  EXPECT_EQ(scene["generator"], kSimulate);
  EXPECT_EQ(scene["scene"], "intrude");
  ASSERT_EQ(scene["bodies"].size(), 2u);
  for (const auto& body : scene["bodies"]) {
    EXPECT_EQ(body["class"], "person");
    ASSERT_EQ(body["way"].size(), body["times"].size());
    for (const auto& corner : body["way"]) // the world is the first sensor's, 0.9 m up
      EXPECT_NEAR(corner.at(2).get<double>(), -0.9, 0.1);
  }
  // It may be done again, in place of this.
  EXPECT_EQ(intrude(folder_ / "out", {"--people", "1"}).exit_code, 0);
}

TEST_F(Intrude, WalksByBetterPosesAndLeavesTheInitialOnes)
{
  fs::copy(scans_->path(), folder_ / "drifting", fs::copy_options::recursive);
  auto poses = pcl6d::readTrajectory(*scans_ / "groundtruth.txt");
  auto drifting = poses;
  for (std::size_t i = 0; i < 6; ++i)
    drifting.poses[i].translation().z() += 2.0 * static_cast<double>(i);
  pcl6d::writeTrajectoryKitti(folder_ / "drifting/odometry.txt", drifting);
  const std::vector<std::string> more = {
      "--people", "2", "--poses", (*scans_ / "groundtruth.txt").string()};
  std::vector<std::string> arguments = {
      "intrude", (folder_ / "drifting").string(), "-o", (folder_ / "out").string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  ASSERT_EQ(run(arguments).exit_code, 0);
  ASSERT_EQ(intrude(folder_ / "exact", more).exit_code, 0);
  const auto written = pcl6d::readTrajectory(folder_ / "out/odometry.txt");
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_TRUE(written.poses[i].isApprox(drifting.poses[i], 1e-12));
    const auto a = pcl6d::readPcd(folder_ / "out" / scanFile(static_cast<int>(i)));
    const auto b = pcl6d::readPcd(folder_ / "exact" / scanFile(static_cast<int>(i)));
    EXPECT_TRUE(a.data == b.data) << "the same people at the same places";
  }
}

TEST_F(Intrude, HasTheSameBytesForTheSameSeed)
{
  const auto bytes = [&](const std::string& name,
                         const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"--people", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(intrude(folder_ / name, arguments).exit_code, 0);
    return contentOf(folder_ / name);
  };
  const auto expected = bytes("one", {"--threads", "1"});
  EXPECT_TRUE(bytes("two", {"--threads", "2"}) == expected);
  EXPECT_TRUE(bytes("eight", {"--threads", "8"}) == expected);
  EXPECT_FALSE(bytes("other", {"--seed", "2"}) == expected);
}

TEST_F(Intrude, NamesWhatCannotBe)
{
  const fs::path out = folder_ / "out";
  const auto expectRefused = [&](const std::vector<std::string>& arguments,
                                 int code,
                                 const std::vector<std::string>& words) {
    expectError(run(arguments), kSimulate, code, words);
    EXPECT_FALSE(fs::exists(out));
  };
  const std::string in = scans_->path().string();
  const std::string to = out.string();
  expectRefused({"intrude", in, "-o", to}, 2, {"--people or --cars"});
  expectRefused({"intrude", "-o", to, "--people", "1"}, 2, {"RUN"});
  expectRefused({"intrude", in, "--people", "1"}, 2, {"output"});
  expectRefused({"intrude", in, "-o", to, "--people", "999"}, 2, {"in [0, 200]"});
  expectRefused({"intrude", in, "-o", to, "--people", "1", "--period", "0"},
                2,
                {"--period", "in [1e-6, 36000]"});
  for (const char* up : {"0,0,0", "1,2", "north", "1,2,3,4", "nan,0,1"})
    expectRefused(
        {"intrude", in, "-o", to, "--people", "1", "--up", up}, 2, {"--up", up});
  expectRefused({"intrude", to + "-none", "-o", to, "--people", "1"}, 1, {"none"});
  writeText(folder_ / "two.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n");
  expectRefused({"intrude",
                 in,
                 "-o",
                 to,
                 "--people",
                 "1",
                 "--poses",
                 (folder_ / "two.txt").string()},
                1,
                {"two.txt", "2 poses", "6 scans"});
  expectRefused({"intrude", in, "-o", to, "--cars", "1", "--up", "1,0,0"}, 1, {"no "});
}

TEST_F(Intrude, WantsPosesAndGroundAndScansOfItsOwn)
{
  const std::string out = folder_ / "out";
  fs::create_directory(folder_ / "other");
  fs::create_directory(folder_ / "bare"); // without poses
  pcl6d::writePcd(folder_ / "bare/scan000.pcd", pcl6d::readPcd(*scans_ / scanFile(0)));
  const std::string bare = folder_ / "bare";
  expectError(
      run({"intrude", bare, "-o", out, "--people", "1"}), kSimulate, 1, {"no poses"});
  // With a pose, but the scan shows a wall only.
  std::string wall = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
                     "WIDTH 400\nHEIGHT 1\nVIEWPOINT 1 0 0 1 0 0 0\nPOINTS 400\nDATA "
                     "ascii\n";
  for (int i = 0; i < 400; ++i)
    wall += std::to_string(0.1 * (i % 20)) + " 4 " +
            std::to_string(1 + 0.1 * (i / 20)) + "\n";
  writeText(folder_ / "bare/scan000.pcd", wall);
  expectError(run({"intrude", bare, "-o", out, "--people", "1"}),
              kSimulate,
              1,
              {"no ground found"});
  ASSERT_EQ(intrude(out, {"--people", "1"}).exit_code, 0);
  expectError(run({"intrude", out, "-o", folder_ / "again", "--people", "1"}),
              kSimulate,
              1,
              {"already has a field dynamic"});
  expectError(run({"intrude",
                   scans_->path().string(),
                   "-o",
                   scans_->path().string(),
                   "--people",
                   "1",
                   "--force"}),
              kSimulate,
              1,
              {"output folder is the input folder"});
  writeText(folder_ / "other/scan000.pcd", "a recording");
  for (const bool force : {false, true}) {
    std::vector<std::string> arguments = {"--people", "1"};
    if (force)
      arguments.emplace_back("--force");
    expectError(intrude(folder_ / "other", arguments), kSimulate, 1, {"other"});
    EXPECT_EQ(readText(folder_ / "other/scan000.pcd"), "a recording");
  }
  EXPECT_FALSE(pcl6d::fieldValues(pcl6d::readPcd(*scans_ / scanFile(0)), "dynamic"));
}
