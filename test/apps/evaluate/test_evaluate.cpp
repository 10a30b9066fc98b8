// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate as a user runs it.
#include "apps/evaluate/evaluate_program.h"
#include "apps/support/program_names.h"
#include "support/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <vector>

namespace fs = std::filesystem;
using pcl6d::test::expectError;
using pcl6d::test::kEvaluate;
using pcl6d::test::Outcome;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {

Outcome
evaluate(const std::vector<std::string>& arguments)
{
  return pcl6d::test::runProgram(kEvaluate, arguments);
}

constexpr const char* kPath = "1 0 0 0 0 1 0 0 0 0 1 0\n"
                              "1 0 0 2 0 1 0 0 0 0 1 0\n"
                              "1 0 0 2 0 1 0 3 0 0 1 0\n";
/** The same, moved by (3, 4, 0). */
constexpr const char* kMoved = "1 0 0 3 0 1 0 4 0 0 1 0\n"
                               "1 0 0 5 0 1 0 4 0 0 1 0\n"
                               "1 0 0 5 0 1 0 7 0 0 1 0\n";

/** A folder with path.txt, moved.txt and the TUM files path.tum, moved.tum. */
struct Files : TempFolder {
  Files()
  {
    writeText(*this / "path.txt", kPath);
    writeText(*this / "moved.txt", kMoved);
    writeText(*this / "path.tum",
              "0 0 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n2 2 3 0 0 0 0 1\n3 9 9 9 0 0 0 1\n");
    writeText(*this / "moved.tum",
              "0.01 3 4 0 0 0 0 1\n1.01 5 4 0 0 0 0 1\n2.01 5 7 0 0 0 0 1\n");
  }
  std::string
  name(const std::string& file) const
  {
    return *this / file;
  }
};
} // namespace

TEST(Evaluate, PrintsErrorsWithoutAlignmentFirst)
{
  const Files files;
  const auto outcome =
      evaluate({"trajectory", files.name("moved.txt"), files.name("path.txt")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto first = outcome.out.find("without alignment");
  const auto second = outcome.out.find("with alignment");
  ASSERT_NE(first, std::string::npos) << outcome.out;
  ASSERT_NE(second, std::string::npos) << outcome.out;
  EXPECT_LT(first, second);
  EXPECT_NE(outcome.out.substr(first, second - first).find("5.0000"), std::string::npos)
      << outcome.out;
}

TEST(Evaluate, WritesTheSameNumbersAsJson)
{
  const Files files;
  const auto to_file = evaluate({"trajectory",
                                 files.name("moved.txt"),
                                 files.name("path.txt"),
                                 "--json",
                                 files.name("errors.json")});
  EXPECT_EQ(to_file.exit_code, 0) << to_file.err;
  EXPECT_NE(to_file.out.find("without alignment"), std::string::npos);
  const auto to_stdout = evaluate(
      {"trajectory", files.name("moved.txt"), files.name("path.txt"), "--json", "-"});
  EXPECT_EQ(to_stdout.out, pcl6d::test::readText(files / "errors.json"));

  const auto json = nlohmann::json::parse(to_stdout.out);
  EXPECT_EQ(json["schema_version"], 1);
  EXPECT_EQ(json["matched_by"], "index");
  EXPECT_EQ(json["pairs"], 3);
  EXPECT_DOUBLE_EQ(json["reference_path_length"], 5);
  EXPECT_DOUBLE_EQ(json["without_alignment"]["position"]["rms"], 5);
  EXPECT_DOUBLE_EQ(json["without_alignment"]["position"]["max"], 5);
  EXPECT_DOUBLE_EQ(json["without_alignment"]["position_rms_percent_of_path"], 100);
  EXPECT_NEAR(json["with_alignment"]["position"]["rms"], 0, 1e-14);
  EXPECT_EQ(json["alignment"]["status"], "ok");
  EXPECT_NEAR(json["alignment"]["T_reference_estimate"][3], -3, 1e-14);
}

TEST(Evaluate, MatchesTumFilesByTime)
{
  const Files files;
  const std::vector<std::string> arguments{
      "trajectory", files.name("moved.tum"), files.name("path.tum"), "--json", "-"};
  const auto json = nlohmann::json::parse(evaluate(arguments).out);
  EXPECT_EQ(json["matched_by"], "time");
  EXPECT_EQ(json["pairs"], 3);
  EXPECT_EQ(json["unmatched_reference"], 1);
  EXPECT_DOUBLE_EQ(json["without_alignment"]["position"]["rms"], 5);

  auto strict = arguments;
  strict.insert(strict.end(), {"--max-time-difference", "0.001"});
  expectError(evaluate(strict), 1, {"moved.tum", "path.tum", "0.001 s"});
}

TEST(Evaluate, ComparesTumWithKittiByIndex)
{
  const Files files;
  const auto outcome = evaluate(
      {"trajectory", files.name("moved.tum"), files.name("path.txt"), "--json", "-"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["matched_by"], "index");
}

TEST(Evaluate, TakesWholeStampsAsTheIndicesOfSelectedScans)
{
  const Files files;
  writeText(files / "selected.tum", "0 3 4 0 0 0 0 1\n2 5 7 0 0 0 0 1\n");
  const auto outcome = evaluate({"trajectory",
                                 files.name("selected.tum"),
                                 files.name("path.txt"),
                                 "--json",
                                 "-"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(json["matched_by"], "index");
  EXPECT_EQ(json["pairs"], 2);
  EXPECT_EQ(json["unmatched_reference"], 1);
  EXPECT_DOUBLE_EQ(json["without_alignment"]["position"]["max"], 5);

  writeText(files / "selected.txt",
            "1 0 0 3 0 1 0 4 0 0 1 0\n1 0 0 5 0 1 0 7 0 0 1 0\n");
  expectError(
      evaluate({"trajectory", files.name("selected.txt"), files.name("path.txt")}),
      1,
      {"2 poses", "has 3", "trajectory.tum"});
}

TEST(Evaluate, SaysWhenThePositionsDetermineNoRotation)
{
  const Files files;
  writeText(files / "two.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 2 0 1 0 0 0 0 1 0\n");
  const auto outcome =
      evaluate({"trajectory", files.name("two.txt"), files.name("two.txt")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("too-few-pairs"), std::string::npos) << outcome.out;
}

TEST(Evaluate, RefusesAWrongCommandLine)
{
  const Files files;
  const std::string path = files.name("path.txt");
  expectError(evaluate({"paint"}), 2, {"trajectory"});
  expectError(evaluate({"poses", path, path}), 2, {"'poses'", "trajectory"});
  expectError(evaluate({"trajectory", path}), 2, {"REFERENCE"});
  expectError(evaluate({"trajectory", path, path, "more"}), 2, {});
  expectError(evaluate({"trajectory", path, path, "--jsn", "x"}), 2, {"--jsn"});
  expectError(evaluate({"trajectory", path, path, "--max-time-difference", "-1"}),
              2,
              {"--max-time-difference = -1"});
  expectError(evaluate({"trajectory", path, path, "--json", path}), 2, {"path.txt"});
  EXPECT_EQ(pcl6d::test::readText(path), kPath) << "inputs are never modified";
}

TEST(Evaluate, NamesWhatIsWrongWithTheData)
{
  const Files files;
  const std::string path = files.name("path.txt");
  writeText(files / "short.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  writeText(files / "words.txt", "1 0 0 zero 0 1 0 0 0 0 1 0\n");
  writeText(files / "empty.txt", "");
  expectError(evaluate({"trajectory", files.name("none.txt"), path}), 1, {"none.txt"});
  expectError(
      evaluate({"trajectory", path, files.name("empty.txt")}), 1, {"empty.txt"});
  expectError(evaluate({"trajectory", path, files.name("words.txt")}),
              1,
              {"words.txt", "line 1", "zero"});
  expectError(evaluate({"trajectory", files.name("short.txt"), path}),
              1,
              {"short.txt", "path.txt", "1 poses", "has 3"});
  expectError(evaluate({"trajectory", path, path, "--json", path + "/below.json"}),
              1,
              {"path.txt/below.json"});
}

TEST(Evaluate, Helps)
{
  const auto overview = evaluate({"--help"});
  EXPECT_EQ(overview.exit_code, 0);
  EXPECT_NE(overview.out.find("trajectory ESTIMATE REFERENCE"), std::string::npos);
  const auto details = evaluate({"trajectory", "--help"});
  EXPECT_EQ(details.exit_code, 0);
  EXPECT_NE(details.out.find("--max-time-difference"), std::string::npos);
  EXPECT_NE(details.out.find("trajectory.tum"), std::string::npos);
  EXPECT_NE(details.out.find("0.02"), std::string::npos) << "defaults are shown";
  EXPECT_EQ(evaluate({"--version"}).exit_code, 0);
}
