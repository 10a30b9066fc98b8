// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_simulate --motion continuous and the odometry models.
#include "apps/support/program_names.h"
#include "support/run_program.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/trajectory_io.h>

#include <algorithm>
#include <cmath>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::contentOf;
using pcl6d::test::kSimulate;
using pcl6d::test::Outcome;
using pcl6d::test::TempFolder;

Outcome
simulateCorridor(const fs::path& out, const std::vector<std::string>& more)
{
  std::vector<std::string> arguments = {"corridor", "-o", out.string()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return pcl6d::test::runProgram(kSimulate, arguments);
}

// Coarse, as a scan then takes less time and more of them fit on the way.
const std::vector<std::string> kOnTheMove =
    {"--motion", "continuous", "--scans", "4", "--resolution", "4"};

std::vector<std::string>
onTheMoveWith(std::vector<std::string> more)
{
  more.insert(more.begin(), kOnTheMove.begin(), kOnTheMove.end());
  return more;
}
} // namespace

TEST(SimulateMotion, ScansOnTheMoveCarryTimesAndStamps)
{
  const TempFolder folder;
  const Outcome outcome =
      simulateCorridor(folder.path(), onTheMoveWith({"--speed", "0.5"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("times.txt"), std::string::npos) << outcome.out;
  const pcl6d::ScanFolder scans(folder.path());
  ASSERT_EQ(scans.stamps().size(), 4u);
  EXPECT_EQ(scans.stamps()[0], 0);
  const auto& poses = pcl6d::readTrajectory(folder / "groundtruth.txt").poses;
  for (std::size_t i = 0; i + 1 < 4; ++i) // a chord is shorter than the way
    EXPECT_LT((poses[i + 1].translation() - poses[i].translation()).norm(),
              0.5 * (scans.stamps()[i + 1] - scans.stamps()[i]) + 0.1);
  const auto times = pcl6d::fieldValues(scans.read(1).cloud, "t");
  ASSERT_TRUE(times);
  EXPECT_FALSE(times->is_integer);
  const auto [first, last] =
      std::minmax_element(times->values.begin(), times->values.end());
  EXPECT_GE(*first, 0);
  EXPECT_GT(*last, 0.5);
  EXPECT_LT(*last, scans.stamps()[1] - scans.stamps()[0]);
  EXPECT_NE(pcl6d::test::readText(folder / "scene.json").find("\"speed\": 0.5"),
            std::string::npos);
}

TEST(SimulateMotion, SweepsTellTheTrueMotionWithinThem)
{
  const TempFolder folder;
  const Outcome outcome = simulateCorridor(folder.path(),
                                           {"--motion",
                                            "continuous",
                                            "--scanner",
                                            "ouster",
                                            "--resolution",
                                            "6",
                                            "--scans",
                                            "12",
                                            "--period",
                                            "0.1",
                                            "--speed",
                                            "0.5",
                                            "--turns-in-place",
                                            "--turn-rate",
                                            "30",
                                            "--vibration",
                                            "0.002"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto truth = pcl6d::readTrajectory(folder / "groundtruth.txt");
  const auto motion = pcl6d::readTrajectory(folder / "groundtruth_motion.txt");
  ASSERT_EQ(motion.stamps.size(), 121u); // every 10 ms of 1.2 s
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_NEAR(motion.stamps[10 * i], 0.1 * static_cast<double>(i), 1e-12);
    const auto error = pcl6d::distanceBetween(motion.poses[10 * i], truth.poses[i]);
    EXPECT_LT(error.translation, 1e-12);
    EXPECT_LT(error.rotation, 1e-7);
  }
  const std::string scene = pcl6d::test::readText(folder / "scene.json");
  for (const char* word :
       {"turns_in_place", "turn_rate", "\"vibration\": 0.002", "period"})
    EXPECT_NE(scene.find(word), std::string::npos) << word;
  ASSERT_EQ(simulateCorridor(folder.path(), {"--scans", "1"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "groundtruth_motion.txt"));
}

TEST(SimulateMotion, StoppingLeavesNoTimes)
{
  const TempFolder folder;
  ASSERT_EQ(simulateCorridor(folder.path(), kOnTheMove).exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "times.txt"));
  ASSERT_EQ(simulateCorridor(folder.path(), {"--scans", "2"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "times.txt")) << "left over from the earlier run";
  EXPECT_FALSE(pcl6d::fieldValues(pcl6d::readScan(folder / "scan000.pcd").cloud, "t"));
  EXPECT_EQ(pcl6d::test::readText(folder / "scene.json").find("motion"),
            std::string::npos);
}

TEST(SimulateMotion, HasTheSameBytesForTheSameSeed)
{
  const TempFolder folder;
  const auto bytes = [&](const std::string& threads) {
    const auto out = folder / threads;
    EXPECT_EQ(simulateCorridor(out, onTheMoveWith({"--threads", threads})).exit_code,
              0);
    return contentOf(out);
  };
  const auto expected = bytes("1");
  EXPECT_TRUE(bytes("2") == expected);
  EXPECT_TRUE(bytes("8") == expected);
}

TEST(SimulateMotion, OdometryIsOfTheKindAskedFor)
{
  const TempFolder folder;
  const auto farthest = [&](const std::string& kind) {
    const auto out = folder / kind;
    EXPECT_EQ(simulateCorridor(out, onTheMoveWith({"--odometry", kind})).exit_code, 0);
    const auto odometry = pcl6d::readTrajectory(out / "odometry.txt").poses;
    const auto truth = pcl6d::readTrajectory(out / "groundtruth.txt").poses;
    double largest = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      largest =
          std::max(largest, pcl6d::distanceBetween(odometry[i], truth[i]).translation);
    return largest;
  };
  EXPECT_EQ(farthest("exact"), 0);
  const double with_eyes = farthest("visual-inertial");
  EXPECT_GT(with_eyes, 0.01);
  EXPECT_GT(farthest("wheel"), 2 * with_eyes);
  const auto seen = pcl6d::readTrajectory(folder / "visual-inertial" / "odometry.txt");
  EXPECT_GT(std::abs(seen.poses[2].translation().z()), 0.3) << "it sees the ramp";
}

TEST(SimulateMotion, NamesWhatCannotBe)
{
  const TempFolder folder;
  const fs::path out = folder / "out";
  const auto expectUsage = [&](const std::vector<std::string>& more,
                               const std::vector<std::string>& words) {
    pcl6d::test::expectError(simulateCorridor(out, more), kSimulate, 2, words);
    EXPECT_FALSE(fs::exists(out));
  };
  expectUsage({"--motion", "hopping"}, {"--motion = hopping", "stop or continuous"});
  expectUsage({"--odometry", "gps"}, {"--odometry = gps", "visual-inertial"});
  for (const std::string speed : {"0", "-1", "nan", "51", "1e9"})
    expectUsage(onTheMoveWith({"--speed", speed}), {"--speed", "in (0, 50]"});
  expectUsage(onTheMoveWith({"--speed", "fast"}), {"fast"});
  expectUsage(onTheMoveWith({"--period", "0.5"}), {"--period = 0.5", "a scan takes"});
  expectUsage(onTheMoveWith({"--turn-rate", "0"}), {"--turn-rate", "in [0.1, 570]"});
  expectUsage(onTheMoveWith({"--vibration", "1"}), {"--vibration", "in [0, 0.1]"});
  for (const std::string option : {"--period", "--turn-rate", "--vibration"})
    expectUsage({option, "0.1"}, {option, "with a stop for each scan"});
  expectUsage({"--turns-in-place"}, {"--turns-in-place", "with a stop"});
  expectUsage({"--motion", "continuous", "--speed", "2"},
              {"--speed = 2", "at most 0.28", "a scan takes 4.8"});
}
