// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate trajectory: RPE, drift, loops, other times; and lengths.
#include "apps/support/program_names.h"
#include "support/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace {
using Json = nlohmann::json;
using pcl6d::test::kEvaluate;
using pcl6d::test::Outcome;
using pcl6d::test::writeText;

/** KITTI rows of a drive around a square of 10 m with a pose per metre, back to the
 * start; without turning. */
std::string
square(double scale)
{
  std::ostringstream rows;
  for (int i = 0; i <= 40; ++i) {
    const int side = i / 10 % 4, along = i % 10;
    const double x = side == 0 ? along : side == 1 ? 10 : side == 2 ? 10 - along : 0;
    const double y = side == 0 ? 0 : side == 1 ? along : side == 2 ? 10 : 10 - along;
    rows << "1 0 0 " << scale * x << " 0 1 0 " << scale * y << " 0 0 1 0\n";
  }
  return rows.str();
}

class EvaluateDrive : public testing::Test {
protected:
  void
  SetUp() override
  {
    writeText(folder / "truth.txt", square(1));
    writeText(folder / "estimate.txt", square(1.01));
  }

  Outcome
  run(std::vector<std::string> more = {}, const std::string& estimate = "estimate.txt")
  {
    more.insert(more.begin(),
                {"trajectory", (folder / estimate).string(), folder / "truth.txt"});
    return pcl6d::test::runProgram(kEvaluate, more);
  }

  Json
  json(std::vector<std::string> more = {})
  {
    more.insert(more.end(), {"--json", "-"});
    const Outcome outcome = run(more);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return Json::parse(outcome.out);
  }

  void
  expectError(const Outcome& outcome, int code, const std::vector<std::string>& words)
  {
    pcl6d::test::expectError(outcome, kEvaluate, code, words);
  }

  pcl6d::test::TempFolder folder;
};
} // namespace

TEST_F(EvaluateDrive, TellsStepsDriftLoopsAndRatios)
{
  const Json j = json();
  constexpr double kTol = 1e-9;
  EXPECT_NEAR(j["steps"]["translation"]["rms"], 0.01, kTol);
  EXPECT_EQ(j["steps"]["count"], 40);
  EXPECT_EQ(j["drift"]["lengths"].size(), 8);
  EXPECT_EQ(j["drift"]["lengths"][7]["length"], 40);
  EXPECT_EQ(j["drift"]["lengths"][7]["count"], 0) << "the path is not longer";
  EXPECT_FALSE(j["drift"]["lengths"][7].contains("translation_per_metre"));
  EXPECT_EQ(j["loop_closure"]["count"], 3) << "within 2 m: poses 38, 39 and 40";
  EXPECT_EQ(j["loop_closure"]["loops"][2]["to"], 40);
  EXPECT_NEAR(j["loop_closure"]["loops"][2]["translation"], 0, kTol);
  EXPECT_NEAR(j["length_ratios"]["max"], 0, kTol);
  EXPECT_NEAR(j["length_ratios"]["scale"], 1.01, kTol);

  const Outcome table = run();
  for (const char* word :
       {"(ATE)", "per step (RPE)", "per distance (RPE)", "loop closure, 3", "ratios"})
    EXPECT_NE(table.out.find(word), std::string::npos) << word << table.out;
}

TEST_F(EvaluateDrive, TakesLengthsAndLoopsOfAUser)
{
  writeText(folder / "loops.txt", "# start and half way\n0 20\n");
  const Json j =
      json({"--lengths", "3.5", "100", "--loops", (folder / "loops.txt").string()});
  ASSERT_EQ(j["drift"]["lengths"].size(), 2);
  EXPECT_EQ(j["drift"]["lengths"][0]["count"], 37);
  EXPECT_EQ(j["loop_closure"]["count"], 1);
  EXPECT_NEAR(j["loop_closure"]["translation"]["rms"], 0.1 * std::sqrt(2), 1e-9);
  EXPECT_EQ(json({"--loop-radius", "0.5"})["loop_closure"]["count"], 1);
  EXPECT_EQ(json({"--loop-path", "41"})["loop_closure"]["count"], 0);
}

TEST_F(EvaluateDrive, WritesARowPerPose)
{
  const std::string file = folder / "errors.csv";
  const Outcome outcome = run({"-o", file});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::istringstream rows(pcl6d::test::readText(file));
  std::string head, first, second;
  std::getline(rows, head);
  std::getline(rows, first);
  std::getline(rows, second);
  EXPECT_EQ(head.rfind("estimate,reference,position,", 0), 0u) << head;
  EXPECT_EQ(first.rfind("0,0,0,0,0,0,", 0), 0u) << first;
  EXPECT_EQ(first.substr(first.size() - 2), ",,") << first;
  EXPECT_EQ(second.rfind("1,1,0.01", 0), 0u) << second;
  EXPECT_EQ(run({"-o", (folder / "errors.json").string()}).exit_code, 0);
  EXPECT_EQ(Json::parse(pcl6d::test::readText(folder / "errors.json")), json());
}

TEST_F(EvaluateDrive, ComparesAtTheTimesOfTheEstimate)
{
  writeText(folder / "truth.txt", "0 0 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n");
  writeText(folder / "half.tum", "0.5 1 0.25 0 0 0 0 1\n7 0 0 0 0 0 0 1\n");
  expectError(run({}, "half.tum"), 1, {"half.tum", "0.02 s"});
  const Outcome outcome = run({"--interpolate", "1", "--json", "-"}, "half.tum");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json j = Json::parse(outcome.out);
  EXPECT_EQ(j["interpolated"], true);
  EXPECT_EQ(j["unmatched_estimate"], 1);
  EXPECT_DOUBLE_EQ(j["without_alignment"]["position"]["rms"], 0.25);
  expectError(run({"--interpolate", "0.5"}, "half.tum"), 1, {"no pose", "in time"});
  expectError(run({"--interpolate", "1"}), 1, {"estimate.txt", "no time stamps"});
}

TEST_F(EvaluateDrive, NamesBrokenRowsAndStamps)
{
  writeText(folder / "nan.txt", square(1) + "1 0 0 nan 0 1 0 0 0 0 1 0\n");
  expectError(run({}, "nan.txt"), 1, {"nan.txt", "line 42", "nan"});
  writeText(folder / "twice.tum", "0 0 0 0 0 0 0 1\n0 1 0 0 0 0 0 1\n");
  expectError(run({}, "twice.tum"), 1, {"twice.tum", "line 2"});
  writeText(folder / "back.tum", "1 0 0 0 0 0 0 1\n0 1 0 0 0 0 0 1\n");
  expectError(run({}, "back.tum"), 1, {"back.tum", "line 2"});
  writeText(folder / "loops.txt", "0 50\n");
  expectError(run({"--loops", (folder / "loops.txt").string()}), 1, {"pose 50"});
}

TEST_F(EvaluateDrive, TwoPairsSayNothingAfterAlignment)
{
  for (const char* const file : {"truth.txt", "two.txt"})
    writeText(folder / file, "0 0 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n");
  const Outcome outcome = run({}, "two.txt");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("only 2 pairs of poses"), std::string::npos)
      << outcome.err;
}

TEST_F(EvaluateDrive, RefusesWrongOptions)
{
  expectError(run({"--lengths", "0"}), 2, {"--lengths = 0"});
  expectError(run({"--interpolate", "-1"}), 2, {"--interpolate = -1"});
  expectError(run({"--loop-radius", "0"}), 2, {"--loop-radius = 0"});
  expectError(run({"--loop-path", "nan"}), 2, {"--loop-path = nan"});
  expectError(run({"-o", "errors.txt"}), 2, {"errors.txt", ".json", ".csv"});
  expectError(run({"--interpolate", "1", "--loops", "x"}), 2, {"--loops"});
  const std::string both = folder / "both.csv";
  expectError(run({"-o", both, "--json", both}), 2, {"--json and --output are both"});
  const std::string truth = folder / "truth.txt";
  EXPECT_EQ(pcl6d::test::readText(truth), square(1));
}

TEST_F(EvaluateDrive, ComparesRatiosOfLengths)
{
  const auto lengths = [&](const std::string& text,
                           std::vector<std::string> more = {}) {
    writeText(folder / "lengths.txt", text);
    more.insert(more.begin(), {"lengths", (folder / "lengths.txt").string()});
    return pcl6d::test::runProgram(kEvaluate, more);
  };
  const std::string file = folder / "ratios.json";
  const Outcome outcome = lengths("# map and plan\n10 5\n"
                                  "0 0 0  3 4 0  2.5\n"
                                  "0 0 0 0 0 10.4  7 0 0 7 5 0\n",
                                  {"-o", file});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json j = Json::parse(pcl6d::test::readText(file));
  EXPECT_EQ(j["ratios"], 3);
  EXPECT_NEAR(j["max"], 1 - 1 / 1.04, 1e-12);
  EXPECT_DOUBLE_EQ(j["scale"], 2);
  expectError(lengths("1 2\n"), 1, {"lengths.txt", "1 lengths"});
  expectError(lengths("1 2\n1 2 3\n"), 1, {"line 2", "3 numbers"});
  expectError(lengths("1 2\n1 nan\n"), 1, {"line 2", "nan"});
  expectError(lengths("1 2\n1 0\n"), 1, {"line 2", "> 0"});
  expectError(lengths("1 2\n1 two\n"), 1, {"line 2", "two"});
}
