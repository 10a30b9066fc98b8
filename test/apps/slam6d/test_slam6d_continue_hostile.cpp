// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d --continue RUN where somebody else has written what is in RUN.
#include "support/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <functional>

namespace {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using pcl6d::test::contentOf;
using pcl6d::test::expectError;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::runProgram;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

/** A run over two of three scans, and what a change of its summary does. */
class ContinueHostile : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    folder_ = new TempFolder;
    ASSERT_EQ(runProgram("pcl_slam6d_simulate",
                         {"corridor", "-o", at("drive"), "--scans", "24", "--quiet"})
                  .exit_code,
              0);
    takeScans(at("scans"), "scan00");
    ASSERT_EQ(slam({"--last", "1", "--voxel", "0.1", "--relaxation", "none"}).exit_code,
              0);
    good_ = readText(summary());
  }
  static void
  TearDownTestSuite()
  {
    delete folder_;
    folder_ = nullptr;
  }
  void
  SetUp() override
  {
    writeText(summary(), good_);
  }

  /** Copies the first three scans of the drive under other names. */
  static void
  takeScans(const fs::path& folder, const std::string& name)
  {
    fs::create_directory(folder);
    std::ifstream all(fs::path(at("drive")) / "odometry.txt");
    std::ofstream odometry(folder / "odometry.txt");
    std::string row;
    for (int i = 0; i < 3 && std::getline(all, row); ++i) {
      const std::string number = std::to_string(i) + ".pcd";
      fs::copy(fs::path(at("drive")) / ("scan00" + number), folder / (name + number));
      odometry << row << '\n';
    }
  }

  static Outcome
  slam(std::vector<std::string> more)
  {
    more.insert(
        more.begin(),
        {at("scans"), "-o", at("run"), "--no-picture", "--loop-closing", "none"});
    return runProgram("pcl_slam6d", more);
  }

  /** Goes on into another folder with a summary in which an option is changed. */
  static Outcome
  goOnWith(const std::string& option, const Json& value)
  {
    return goOn([&](Json& json) {
      json["options"][option] = {{"value", value}, {"source", "given"}};
    });
  }
  static Outcome
  goOn(const std::function<void(Json&)>& change, std::vector<std::string> more = {})
  {
    Json json = Json::parse(good_);
    change(json);
    writeText(summary(), json.dump());
    fs::remove_all(at("out"));
    more.insert(more.begin(),
                {at("scans"), "--continue", at("run"), "-o", at("out"), "--quiet"});
    return runProgram("pcl_slam6d", more);
  }

  static std::string
  at(const std::string& name)
  {
    return (*folder_ / name).string();
  }
  static std::string
  summary()
  {
    return at("run") + "/summary.json";
  }

  static TempFolder* folder_;
  static std::string good_;
};
TempFolder* ContinueHostile::folder_ = nullptr;
std::string ContinueHostile::good_;
} // namespace

TEST_F(ContinueHostile, AValueWithALineBreakIsNoOtherOption)
{
  const std::string elsewhere = at("elsewhere");
  for (const char* option : {"voxel", "metric", "search", "seed", "filter"}) {
    const Outcome outcome = goOnWith(option, "0.1\noutput = " + elsewhere);
    expectError(outcome, "pcl_slam6d", 1, {summary(), option});
    EXPECT_FALSE(fs::exists(elsewhere)) << option;
    EXPECT_FALSE(fs::exists(at("out"))) << option;
  }
}

TEST_F(ContinueHostile, OptionsThatNoRunBringsAreRefused)
{
  for (const char* option : {"output",
                             "config",
                             "live-view",
                             "force",
                             "fresh",
                             "memory",
                             "quiet",
                             "SCAN_DIR",
                             "help",
                             "nonsense"})
    expectError(goOnWith(option, "yes"), "pcl_slam6d", 1, {"summary.json", option});
}

TEST_F(ContinueHostile, NoFileChoosesTheCodeThatRuns)
{
  const std::string plugin = at("stranger.so");
  expectError(goOnWith("plugin", plugin),
              "pcl_slam6d",
              2,
              {"summary.json", "--plugin " + plugin});
  expectError(
      goOn(
          [&](Json& json) {
            json["options"]["plugin"] = {{"value", plugin}, {"source", "given"}};
          },
          {"--plugin", at("mine.so")}),
      "pcl_slam6d",
      2,
      {"mine.so", "No such file"});
}

TEST_F(ContinueHostile, ValuesObeyTheRulesOfTheirOptions)
{
  for (const auto& [option, value] : {std::pair("voxel", "-1"),
                                      {"voxel", "nan"},
                                      {"metric", "best"},
                                      {"seed", "-1"},
                                      {"iterations", "1e99"},
                                      {"min-overlap", "7"},
                                      {"deskew", "perhaps"}})
    expectError(goOnWith(option, value),
                "pcl_slam6d",
                1,
                {summary(), std::string("option '") + option + "'"});
}

TEST_F(ContinueHostile, WhatTheRunReadIsNotTakenAgain)
{
  const std::string file = at("secret");
  const Outcome outcome = goOn([&](Json& json) {
    for (const char* option : {"poses", "graph-in", "continue"})
      json["options"][option] = {{"value", file}, {"source", "given"}};
    json["options"]["threads"] = {{"value", "100000"}, {"source", "given"}};
    json["options"]["last"] = {{"value", "0"}, {"source", "given"}};
  });
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Json json = Json::parse(readText(at("out") + "/summary.json"));
  EXPECT_EQ(json["scans"].size(), 3u);
  EXPECT_EQ(json["options"]["voxel"]["value"], "0.1") << "this is";
}

TEST_F(ContinueHostile, EveryOptionOfASummaryMayComeBack)
{
  const Json options = Json::parse(good_)["options"];
  for (const auto& [name, option] : options.items()) {
    if (name == "plugin")
      continue;
    std::string value = option["value"];
    if (value == "none" &&
        (name == "poses" || name == "graph-in" || name == "continue" ||
         name == "project" || name == "tolerance"))
      continue;
    Json json = Json::parse(good_);
    json["options"][name]["source"] = "given";
    writeText(summary(), json.dump());
    // Nothing is computed: the next check refuses the command line.
    const Outcome outcome = runProgram(
        "pcl_slam6d", {at("scans"), "--continue", at("run"), "--resume", "--fresh"});
    expectError(outcome, "pcl_slam6d", 2, {"--resume and --fresh contradict"});
  }
}

TEST_F(ContinueHostile, ScansWithNamesThatAreNoUtf8AreKnownAgain)
{
  const std::string run = at("latin"), input = at("latin scans");
  takeScans(input, "s\xe4ule");
  const std::vector<std::string> rules = {
      "--loop-closing", "none", "--relaxation", "none", "--no-picture", "--quiet"};
  std::vector<std::string> first = {input, "-o", run, "--last", "1"};
  first.insert(first.end(), rules.begin(), rules.end());
  ASSERT_EQ(runProgram("pcl_slam6d", first).exit_code, 0);
  const Outcome outcome =
      runProgram("pcl_slam6d", {input, "--continue", run, "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(Json::parse(readText(run + "/summary.json"))["scans"].size(), 3u);
}

TEST_F(ContinueHostile, NamesThatAnOlderVersionDidNotKeepAreRefused)
{
  expectError(
      goOn([](Json& json) { json["scans"][1]["file"] = "s\xef\xbf\xbdule1.pcd"; }),
      "pcl_slam6d",
      1,
      {summary(), "the name of scan 1 is no UTF-8"});
}
