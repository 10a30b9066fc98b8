// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate map as a user runs it.
#include "support/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <regex>
#include <sstream>

namespace fs = std::filesystem;

namespace {
using Json = nlohmann::json;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::runProgram;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

constexpr const char* kName = "pcl_slam6d_evaluate";

/** Simulated scans of a corridor and a run over them, made once. */
const fs::path&
made()
{
  static const TempFolder folder;
  static const fs::path path = folder / "made";
  if (!fs::exists(path)) {
    fs::create_directory(path);
    runProgram(
        "pcl_slam6d_simulate",
        {"corridor", "-o", path / "scans", "--seed", "3", "--scans", "40", "--quiet"});
    runProgram("pcl_slam6d", {path / "scans", "-o", path / "run", "--last", "9"});
  }
  return path;
}

Outcome
map(std::vector<std::string> arguments)
{
  arguments.insert(arguments.begin(), "map");
  arguments.push_back("--quiet");
  return runProgram(kName, arguments);
}

void
expectError(const Outcome& outcome, int code, const std::vector<std::string>& words)
{
  pcl6d::test::expectError(outcome, kName, code, words);
}

std::string
run()
{
  return made() / "run";
}

/** A copy of the run that a test may spoil. */
struct RunCopy : TempFolder {
  RunCopy() { fs::copy(run(), *this / "run", fs::copy_options::recursive); }

  Outcome
  measured() const
  {
    return map({(*this / "run").string()});
  }
  void
  replace(const std::string& what, const std::string& by) const
  {
    const fs::path file = *this / "run/summary.json";
    writeText(file, std::regex_replace(readText(file), std::regex(what), by));
  }
};
} // namespace

TEST(EvaluateMap, TellsHowGoodARunIs)
{
  const TempFolder out;
  const std::string json = out / "map.json";
  const Outcome outcome = map({run(), "-o", json});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  for (const char* word : {"10 scans", "agreement", "entropy", "thickness", "revisits"})
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word << '\n' << outcome.out;
  const Json j = Json::parse(readText(json));
  EXPECT_EQ(j["schema_version"], 1);
  EXPECT_EQ(j["scans"].size(), 10);
  EXPECT_EQ(j["scans"][0]["file"], "scan000.pcd");
  EXPECT_GT(j["agreement"], 0.1);
  EXPECT_GT(j["planes"].size(), 2);
  EXPECT_LT(j["thickness"], 0.1);
  EXPECT_FALSE(j.contains("reference"));
  const std::size_t end = outcome.out.find_last_not_of('\n');
  const std::string verdict = j["verdict"];
  EXPECT_EQ(outcome.out.substr(end + 1 - verdict.size(), verdict.size()), verdict)
      << "the last line";
}

TEST(EvaluateMap, HasTheSameBytesForAnyNumberOfThreads)
{
  const TempFolder out;
  EXPECT_EQ(map({run(), "-o", out / "1.json", "--threads", "1"}).exit_code, 0);
  EXPECT_EQ(map({run(), "-o", out / "3.json", "--threads", "3"}).exit_code, 0);
  EXPECT_EQ(readText(out / "1.json"), readText(out / "3.json"));
}

TEST(EvaluateMap, RanksTheRunBeforeItsOdometry)
{
  const TempFolder out;
  std::string rows; // those of the first ten scans
  std::istringstream odometry(readText(made() / "scans/odometry.txt"));
  std::string row;
  for (int i = 0; i < 10 && std::getline(odometry, row); ++i)
    rows += row + '\n';
  writeText(out / "odometry.txt", rows);
  ASSERT_EQ(map({run(), "-o", out / "good.json"}).exit_code, 0);
  const Outcome outcome = map(
      {run(), "--poses", out / "odometry.txt", "-o", out / "bad.json", "--rows", "2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json good = Json::parse(readText(out / "good.json")),
             bad = Json::parse(readText(out / "bad.json"));
  EXPECT_GT(good["agreement"], bad["agreement"]);
  EXPECT_LT(good["entropy"], bad["entropy"]);
  EXPECT_LT(good["thickness"], bad["thickness"]);
}

TEST(EvaluateMap, MeasuresAFolderOfScansAndAReference)
{
  const TempFolder out;
  const std::string csv = out / "map.csv";
  const Outcome outcome =
      map({run() + "/scans", "--reference", run() + "/map.pcd", "-o", csv});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("PCD VIEWPOINT"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("to the reference"), std::string::npos) << outcome.out;
  std::istringstream rows(readText(csv));
  std::string head, row;
  std::getline(rows, head);
  EXPECT_EQ(head.rfind("file,neighbours,agreement,", 0), 0u);
  std::size_t count = 0;
  for (; std::getline(rows, row); ++count)
    EXPECT_EQ(std::count(row.begin(), row.end(), ','), 11) << row;
  EXPECT_EQ(count, 10u);
}

TEST(EvaluateMap, NamesWhatIsWrongWithTheMap)
{
  expectError(map({"/nowhere"}), 1, {"/nowhere"});
  const TempFolder empty;
  fs::create_directory(empty / "in");
  expectError(map({empty / "in"}), 1, {"in"});

  const RunCopy interrupted;
  interrupted.replace("\"complete\": true", "\"complete\": false");
  expectError(interrupted.measured(), 1, {"summary.json", "interrupted"});
  const RunCopy foreign;
  foreign.replace("\"generator\": \"pcl_slam6d\"", "\"generator\": \"other\"");
  expectError(foreign.measured(), 1, {"summary.json", "'other'"});
  const RunCopy missing;
  fs::remove(missing / "run/scans/scan004.pcd");
  expectError(missing.measured(), 1, {"scan004.pcd", "is missing"});

  const TempFolder one;
  fs::create_directory(one / "in");
  fs::copy_file(run() + "/scans/scan003.pcd", one / "in/scan003.pcd");
  expectError(map({one / "in"}), 1, {"one scan"});
}

TEST(EvaluateMap, NamesWithEscapeCodesAreSafeForATerminal)
{
  const TempFolder folder;
  fs::create_directory(folder / "in");
  for (const char* const number : {"0", "1", "2"})
    fs::copy_file(run() + "/scans/scan00" + number + ".pcd",
                  folder / "in" / (std::string("x\x1b[31m\a") + number + ".pcd"));
  const Outcome outcome = map({folder / "in"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find_first_of("\x1b\a"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("x\\x1b[31m"), std::string::npos) << outcome.out;
}

TEST(EvaluateMap, NamesWhatIsWrongWithTheScans)
{
  const RunCopy copy;
  const std::string head = "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\n"
                           "COUNT 1 1 1\nWIDTH 4\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n"
                           "POINTS 4\nDATA ascii\n";
  writeText(copy / "run/scans/scan002.pcd",
            head + "nan nan nan\nnan nan nan\nnan nan nan\n1 2 3\n");
  expectError(copy.measured(), 1, {"scan002.pcd", "but its run wrote"});
  const fs::path summary = copy / "run/summary.json"; // one that does not tell
  auto json = nlohmann::ordered_json::parse(readText(summary));
  json.erase("files");
  writeText(summary, json.dump());
  expectError(copy.measured(), 1, {"scan002.pcd", "1 points"});
  writeText(copy / "run/scans/scan002.pcd",
            "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
            "WIDTH 0\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 0\nDATA ascii\n");
  expectError(copy.measured(), 1, {"scan002.pcd"});

  const TempFolder poses;
  writeText(poses / "two.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 0\n");
  expectError(
      map({run(), "--poses", poses / "two.txt"}), 1, {"two.txt", "2 poses", "10"});
  writeText(poses / "nan.txt", "1 0 0 nan 0 1 0 0 0 0 1 0\n");
  expectError(map({run(), "--poses", poses / "nan.txt"}), 1, {"nan.txt", "line 1"});
  expectError(map({run(), "--reference", "/nowhere.pcd"}), 1, {"/nowhere.pcd"});
}

TEST(EvaluateMap, RefusesAWrongCommandLine)
{
  expectError(map({}), 2, {"RUN_DIR"});
  expectError(map({run(), "--voxel", "0"}), 2, {"--voxel = 0"});
  expectError(map({run(), "--radius", "-1"}), 2, {"--radius = -1"});
  expectError(map({run(), "--max-distance", "nan"}), 2, {"--max-distance = nan"});
  expectError(map({run(), "--outlier", "0"}), 2, {"--outlier = 0"});
  expectError(map({run(), "-o", "map.txt"}), 2, {"map.txt", ".json"});
  const Outcome help = map({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_NE(help.out.find("--reference"), std::string::npos);
}
