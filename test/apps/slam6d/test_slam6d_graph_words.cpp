// SPDX-License-Identifier: BSD-3-Clause
// Each word of --loop-closing, --relaxation and --links: a whole run that improves on the
// odometry, and says in its summary what was used.
#include "support/run_program.h"

#include <pcl6d/io/trajectory_io.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <memory>
#include <set>

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using pcl6d::test::readText;
using pcl6d::test::runProgram;
using pcl6d::test::TempFolder;
using Words = std::vector<std::string>;

/** A loop of 28 scans, as loops need 20 scans between their ends; relaxation sees the
 * first eleven of them. Matched pairwise, so that something is left to improve. */
class GraphWords : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    folder_ = std::make_unique<TempFolder>();
    const auto outcome = runProgram("pcl_slam6d_simulate",
                                    {"corridor",
                                     "-o",
                                     *folder_ / "scans",
                                     "--scans",
                                     "28",
                                     "--resolution",
                                     "3",
                                     "--seed",
                                     "2",
                                     "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  static void
  TearDownTestSuite()
  {
    folder_.reset();
  }

  /** Position rms [m] against the truth, without alignment. */
  static double
  rmsOf(const fs::path& trajectory, std::size_t scans)
  {
    const auto found = pcl6d::readTrajectory(trajectory).poses;
    const auto truth = pcl6d::readTrajectory(*folder_ / "scans/groundtruth.txt").poses;
    double sum = 0;
    for (std::size_t i = 0; i < scans; ++i)
      sum += (found.at(i).translation() - truth.at(i).translation()).squaredNorm();
    return std::sqrt(sum / static_cast<double>(scans));
  }

  /** Runs over the first scans with an option, expects at most half of the odometry's
   * error and the option in the summary. */
  static json
  summaryOf(const std::string& option,
            const std::string& word,
            std::size_t scans,
            const Words& more)
  {
    SCOPED_TRACE(option + " " + word);
    const fs::path out = *folder_ / "out";
    Words words = {*folder_ / "scans", "-o", out, "--last"};
    words.push_back(std::to_string(scans - 1));
    words.insert(words.end(), {"--metascan", "1", "--no-picture", "--no-verification"});
    words.insert(words.end(), {"--" + option, word});
    words.insert(words.end(), more.begin(), more.end());
    const auto outcome = runProgram("pcl_slam6d", words);
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.err;
    EXPECT_LT(rmsOf(out / "trajectory.kitti", scans),
              0.5 * rmsOf(*folder_ / "scans/odometry.txt", scans));
    json summary = json::parse(readText(out / "summary.json"));
    EXPECT_EQ(summary["options"][option]["value"], word);
    EXPECT_EQ(summary["options"][option]["source"], "given");
    return summary;
  }

  /** \return the stage of that name; null if there is none */
  static json
  stageOf(const json& summary, const std::string& name)
  {
    for (const json& stage : summary.at("graph").at("stages"))
      if (stage.at("name") == name)
        return stage;
    return {};
  }

  static std::unique_ptr<TempFolder> folder_;
};
std::unique_ptr<TempFolder> GraphWords::folder_;

constexpr std::size_t kAll = 28, kPart = 11; // scans
} // namespace

TEST_F(GraphWords, EachLoopClosingSpreadsTheErrorInItsOwnWay)
{
  std::set<double> agreements;
  for (const char* const word : {"elch", "uniform", "path"}) {
    const json summary =
        summaryOf("loop-closing", word, kAll, {"--relaxation", "none"});
    const json stage = stageOf(summary, "loop closing");
    ASSERT_FALSE(stage.is_null()) << word;
    agreements.insert(stage.at("agreement_after").get<double>());
    EXPECT_TRUE(stageOf(summary, "relaxation").is_null());
  }
  EXPECT_EQ(agreements.size(), 3u);
}

TEST_F(GraphWords, WithoutLoopClosingNoLoopIsLookedFor)
{
  const json summary =
      summaryOf("loop-closing", "none", kAll, {"--relaxation", "none"});
  EXPECT_TRUE(stageOf(summary, "loop closing").is_null());
  EXPECT_TRUE(stageOf(summary, "relaxation").is_null());
}

TEST_F(GraphWords, EachRelaxationGoesItsOwnWay)
{
  std::set<double> agreements;
  const Words all = {
      "helix", "euler", "quaternion", "quaternion-published", "small-angle"};
  for (const auto& word : all) {
    const json stage = stageOf(summaryOf("relaxation", word, kPart, {}), "relaxation");
    ASSERT_FALSE(stage.is_null()) << word;
    EXPECT_GT(stage.at("rounds").get<int>(), 0) << word;
    agreements.insert(stage.at("agreement_after").get<double>());
  }
  EXPECT_GE(agreements.size(), 3u) << "all but the exact ones agree to the last bits";
  EXPECT_TRUE(
      stageOf(summaryOf("relaxation", "none", kPart, {}), "relaxation").is_null());
}

TEST_F(GraphWords, LinksByDistanceAreOtherLinks)
{
  std::set<std::string> links;
  for (const char* const word : {"overlap", "distance"}) {
    const json summary = summaryOf("links", word, kPart, {});
    EXPECT_FALSE(stageOf(summary, "relaxation").is_null());
    EXPECT_GT(summary["graph"]["links_used"].get<int>(), 0);
    links.insert(readText(*folder_ / "out/links.csv"));
  }
  EXPECT_EQ(links.size(), 2u);
}

TEST_F(GraphWords, ParametersOfLoopsAreToldWithTheirReasonWhereThereIsAStage)
{
  const auto told = [](const Words& more) {
    Words words = {*folder_ / "scans", "-o", *folder_ / "told", "--last", "5"};
    words.insert(words.end(), {"--no-picture", "--no-verification", "--force"});
    words.insert(words.end(), more.begin(), more.end());
    const auto outcome = runProgram("pcl_slam6d", words);
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 3) << outcome.err;
    return outcome.err; // coarse scans may be doubted
  };
  const std::string with = told({"--loop-gap", "30"});
  for (const char* line :
       {"  loop-distance = ",
        " m (auto: larger of half the median range and 4 median steps)",
        "  loop-gap = 30 scans (given)",
        "  link-distance = "})
    EXPECT_NE(with.find(line), std::string::npos) << line << '\n' << with;
  EXPECT_EQ(with.find("(auto: )"), std::string::npos) << with;
  const std::string without = told({"--loop-closing", "none", "--relaxation", "none"});
  EXPECT_NE(without.find("  voxel = "), std::string::npos);
  EXPECT_EQ(without.find("loop-"), std::string::npos) << without;
}
