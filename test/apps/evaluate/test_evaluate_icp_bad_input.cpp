// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate icp when something is wrong.
#include "apps/evaluate/evaluate_program.h"
#include "apps/support/room_pair.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::evaluateIcp;
using pcl6d::test::expectError;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::RoomPair;
using pcl6d::test::writeText;

} // namespace

TEST(EvaluateIcp, SaysThatScansCannotBeMatched)
{
  const RoomPair pair;
  const auto outcome =
      evaluateIcp(pair.arguments({"--guess", "50 0 0 0 0 0", "-o", pair / "out"}));
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("metric point: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("b.xyz cannot be matched onto"), std::string::npos);
  EXPECT_NE(outcome.err.find("from the unperturbed start: ICP stopped: too few pairs"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(outcome.out.find("correct %"), std::string::npos) << outcome.out;
  const auto json = nlohmann::json::parse(readText(pair / "out/icp.json"));
  EXPECT_FALSE(json["best"][0]["reliable"]);
  const std::string csv = readText(pair / "out/icp.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1) << "names of columns only";
}

TEST(EvaluateIcp, SaysThatMetricsDisagree)
{
  const RoomPair pair;
  const auto outcome = evaluateIcp(pair.arguments({"--metric=plane",
                                                   "--metric=gicp",
                                                   "--sigma-position=1e-4",
                                                   "--sigma-orientation=0.01",
                                                   "-o",
                                                   pair / "out"}));
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("warning: the best poses of plane and gicp are 0.0"),
            std::string::npos)
      << outcome.err;
  const auto json = nlohmann::json::parse(readText(pair / "out/icp.json"));
  ASSERT_EQ(json["disagreements"].size(), 1u);
  EXPECT_GT(json["disagreements"][0]["position"], 0);
}

TEST(EvaluateIcp, SaysThatThereAreNoPoses)
{
  const RoomPair pair;
  fs::remove(pair / "odometry.txt");
  const auto warned = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = {"--metric=plane", "--quiet"};
    all.insert(all.end(), more.begin(), more.end());
    return evaluateIcp(pair.arguments(all)).err.find("no poses were found") !=
           std::string::npos;
  };
  EXPECT_TRUE(warned({}));
  EXPECT_FALSE(warned({"--guess", "0.4 -0.2 0.05 1.1 -0.6 11.5"}));
}

TEST(EvaluateIcp, SaysWhichOptionsHaveNoEffect)
{
  const RoomPair pair;
  const std::string a = pair / "a.xyz", b = pair / "b.xyz";
  const auto errorsOf = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {a, b, "--voxel=0.2", "--steps-xy=1", "--quiet"});
    words.emplace_back("--steps-yaw=1");
    return evaluateIcp(words).err;
  };
  EXPECT_EQ(errorsOf({"--metric=plane", "--minimiser=svd"}),
            "warning: no effect in this run: --minimiser (of the metric point)\n");
  EXPECT_EQ(errorsOf({"--metric=plane"}), "") << "defaults are not given in vain";
  EXPECT_EQ(errorsOf({"--metric=all", "--minimiser=svd", "--plane-minimiser=linear"}),
            "");
  const std::string two =
      errorsOf({"--metric=point", "--plane-minimiser=linear", "--offset-yaw=2"});
  EXPECT_EQ(
      two,
      "warning: no effect in this run: --plane-minimiser (of the metrics plane and "
      "gicp), --offset-yaw (with --steps-yaw 3 or more)\n");
}

TEST(EvaluateIcp, RefusesAWrongCommandLine)
{
  const RoomPair pair;
  const std::string a = pair / "a.xyz", b = pair / "b.xyz";
  expectError(evaluateIcp({a}), 2, {"SCAN_B"});
  expectError(evaluateIcp({a, b, "more"}), 2, {"SCAN_A SCAN_B"});
  const auto refused = [&](const std::vector<std::string>& options,
                           const std::vector<std::string>& words) {
    std::vector<std::string> arguments = {a, b, "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expectError(evaluateIcp(arguments), 2, words);
  };
  refused({"--minimiser", "newton"}, {"--minimiser = newton", "quaternion"});
  refused({"--plane-minimiser", "svd"}, {"svd", "helix"});
  refused({"--metric", "line"}, {"--metric = line", "gicp"});
  refused({"--search", "hash"}, {"--search = hash", "brute-force"});
  refused({"--robust", "tukey"}, {"--robust = tukey"});
  refused({"--steps-xy", "0"}, {"--steps-xy = 0", "odd"});
  refused({"--steps-yaw", "2"}, {"--steps-yaw = 2", "odd"});
  refused({"--steps-xy", "1001"}, {"--steps-xy = 1001", "100000 starts"});
  refused({"--offset-xy", "-1"}, {"--offset-xy = -1"});
  refused({"--offset-xy", "nan"}, {"--offset-xy = nan"});
  refused({"--offset-yaw", "200"}, {"--offset-yaw = 200", "degrees"});
  refused({"--sigma-position", "0"}, {"--sigma-position = 0"});
  refused({"--sigma-orientation", "-2"}, {"--sigma-orientation = -2", "degrees"});
  refused({"--guess", "1 2 3"}, {"--guess", "six finite numbers"});
  refused({"--guess", "1 2 3 4 5 nan"}, {"--guess", "six finite numbers"});
  refused({"--guess", "inf 2 3 4 5 6"}, {"--guess", "six finite numbers"});
  refused({"--guess", "1 2 3 4 5 6 7"}, {"--guess", "more than six"});
  refused({"--voxel", "0"}, {"--voxel = 0"});
  refused({"--iterations", "0"}, {"--iterations = 0"});
  refused({"--threads", "-1"}, {"--threads = -1"});
  refused({"--format", "e57"}, {"--format = 'e57'"});
}

TEST(EvaluateIcp, NamesWhatIsWrongWithTheData)
{
  const RoomPair pair;
  const std::string a = pair / "a.xyz", b = pair / "b.xyz";
  writeText(pair / "nan.xyz", "nan nan nan\nnan 0 0\n0 0 nan\n1 2 3\n");
  writeText(pair / "empty.xyz", "");
  writeText(pair / "words.xyz", "1 2 three\n");
  expectError(evaluateIcp({pair / "none.xyz", b}), 1, {"none.xyz"});
  expectError(evaluateIcp({a, pair / "none.xyz"}), 1, {"none.xyz"});
  expectError(evaluateIcp({a, pair / "nan.xyz"}),
              1,
              {"nan.xyz", "1 points with finite coordinates", "3 without"});
  expectError(evaluateIcp({pair / "empty.xyz", b}), 1, {"empty.xyz"});
  expectError(evaluateIcp({pair / "words.xyz", b}), 1, {"words.xyz", "three"});
  expectError(evaluateIcp({pair.path(), b}), 1, {pair.path()});
  fs::remove(pair / "nan.xyz"), fs::remove(pair / "empty.xyz");
  expectError(
      evaluateIcp({a, b}), 1, {"odometry.txt", "words.xyz"}); // two poses for three
  fs::remove(pair / "words.xyz");
  expectError(evaluateIcp({a, b, "--max-range", "0.5"}), 1, {"a.xyz", "range gate"});
  expectError(evaluateIcp({a, b, "-o", a + "/out"}), 1, {"a.xyz/out"});
  expectError(
      evaluateIcp({a, b, "-o", pair.path()}), 1, {"lies inside the output folder"});
  EXPECT_FALSE(readText(a).empty()) << "inputs are never modified";
}

TEST(EvaluateIcp, TakesThePosesOfScansInTwoFolders)
{
  const RoomPair pair;
  fs::create_directory(pair / "other");
  fs::rename(pair / "b.xyz", pair / "other/b.xyz");
  const std::string a = pair / "a.xyz", b = pair / "other/b.xyz";
  const std::vector<std::string> quick = {
      "--quiet", "--steps-xy=1", "--steps-yaw=1", "--voxel=0.3", "--metric=plane"};
  const auto run = [&] {
    std::vector<std::string> arguments = {a, b};
    arguments.insert(arguments.end(), quick.begin(), quick.end());
    return evaluateIcp(arguments);
  };
  writeText(pair / "odometry.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  expectError(run(), 1, {"odometry.txt", "identity", "--guess"});
  writeText(pair / "other/odometry.txt", "1 0 0 0.4 0 1 0 -0.2 0 0 1 0\n");
  const auto outcome = run();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}
