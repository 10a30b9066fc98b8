// SPDX-License-Identifier: BSD-3-Clause
// The report of the demo's drive, as a user gets it.
#include "apps/support/corridor_run.h"
#include "support/browser.h"

#include <gtest/gtest.h>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::expectError;
using pcl6d::test::expectPassed;
using pcl6d::test::findBrowser;
using pcl6d::test::isChecked;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::runProgram;
using pcl6d::test::scans;
using pcl6d::test::selfTestOf;
using pcl6d::test::slam;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

constexpr const char* kRender = "pcl_slam6d_render";

/** A run with planes and a report, made once for all tests. */
const fs::path&
demo()
{
  static const TempFolder folder;
  static const fs::path out = folder / "demo";
  if (!fs::exists(out))
    slam(scans(), out, {"--last", "7", "--planes", "--report", "--quiet"});
  return out;
}

/** A run in which people walked, made once for all tests. */
const fs::path&
busy()
{
  static const TempFolder folder;
  static const fs::path out = folder / "busy";
  if (fs::exists(out))
    return out;
  const std::string in = folder / "scans";
  runProgram("pcl_slam6d_simulate",
             {"corridor",
              "--people",
              "3",
              "--scans",
              "20",
              "--resolution",
              "2",
              "--seed",
              "3",
              "-o",
              in,
              "--quiet"});
  slam(in, out, {"--last", "7", "--report", "--no-picture", "--quiet"});
  return out;
}

/** A copy of a run, to be spoilt. */
struct Copy : TempFolder {
  explicit Copy(const fs::path& run = demo())
  {
    fs::copy(run, path(), fs::copy_options::recursive);
  }
};

bool
holds(const fs::path& page, const std::string& word)
{
  return readText(page).find(word) != std::string::npos;
}
} // namespace

TEST(RenderReport, IsWhatTheRunItselfWrites)
{
  ASSERT_TRUE(fs::exists(demo() / "report.html"));
  const TempFolder folder;
  const fs::path page = folder / "again.html";
  const Outcome outcome =
      runProgram(kRender, {"report", demo().string(), "-o", page.string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find(page.string()), std::string::npos) << outcome.out;
  EXPECT_TRUE(readText(page) == readText(demo() / "report.html"));
}

TEST(RenderReport, OfTheDemoWorksOnDesktopAndPhone)
{
  if (findBrowser().empty())
    GTEST_SKIP() << "no browser: apt-get install chromium";
  for (const auto& [width, height] : {std::pair(1280, 900), {390, 844}}) {
    SCOPED_TRACE(width);
    const auto outcome = selfTestOf(demo() / "report.html", width, height);
    expectPassed(outcome);
    EXPECT_EQ(outcome["width"], width);
  }
}

TEST(RenderReport, TellsWhatMoved)
{
  const auto moved =
      nlohmann::json::parse(readText(busy() / "summary.json"))["dynamic"];
  ASSERT_EQ(moved["points"].size(), 8u);
  std::size_t points = 0;
  for (const auto& of_scan : moved["points"])
    points += of_scan.get<std::size_t>();
  EXPECT_GT(points, 100u);
  const TempFolder folder;
  const fs::path page = folder / "again.html";
  const Outcome outcome =
      runProgram(kRender, {"report", busy().string(), "-o", page.string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(readText(page) == readText(busy() / "report.html"));
  EXPECT_TRUE(holds(page, "\"moving\":{\"points\":" + std::to_string(points) + ','));
  if (findBrowser().empty())
    GTEST_SKIP() << "no browser: apt-get install chromium";
  const auto outcome_in_browser = selfTestOf(page, 1280, 900);
  expectPassed(outcome_in_browser);
  EXPECT_TRUE(isChecked(outcome_in_browser, "what moved is red"));
}

TEST(RenderReport, NamesWhatMovedWhereItIsMissingOrBroken)
{
  const Copy run(busy());
  fs::remove(run / "moving.pcd");
  const Outcome missing = runProgram(kRender, {"report", run.path().string()});
  EXPECT_EQ(missing.exit_code, 0) << missing.err;
  EXPECT_NE(missing.err.find("missing: moving.pcd"), std::string::npos) << missing.err;
  writeText(run / "moving.pcd", "{");
  const Outcome broken = runProgram(kRender, {"report", run.path().string()});
  EXPECT_EQ(broken.exit_code, 3) << broken.err;
  EXPECT_NE(broken.err.find("moving.pcd"), std::string::npos) << broken.err;
}

TEST(RenderReport, SaysWhatIsMissingOrBroken)
{
  const Copy run;
  fs::remove(run / "map.pcd");
  fs::remove_all(run / "frames");
  writeText(run / "planes.json", "[");
  writeText(run / "top_view.png", "no picture");
  const Outcome outcome = runProgram(kRender, {"report", run.path().string()});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  for (const char* const what : {"missing: map.pcd",
                                 "missing: frames",
                                 "planes.json",
                                 "top_view.png is no picture"}) {
    EXPECT_NE(outcome.err.find(what), std::string::npos) << what << ": " << outcome.err;
    EXPECT_TRUE(holds(run / "report.html", what)) << what;
  }
}

TEST(RenderReport, OfEachBrokenFileTheExitCodeSaysSo)
{
  for (const std::string name : {"map.pcd", "links.csv", "planes.json", "planes.png"}) {
    SCOPED_TRACE(name);
    const Copy run;
    writeText(run / name, "{");
    const Outcome outcome = runProgram(kRender, {"report", run.path().string()});
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
    EXPECT_TRUE(fs::exists(run / "report.html"));
  }
}

TEST(RenderReport, WhatIsMerelyMissingIsNoFault)
{
  const Copy run;
  fs::remove(run / "map.pcd");
  const Outcome outcome = runProgram(kRender, {"report", run.path().string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("missing: map.pcd"), std::string::npos) << outcome.err;
}

TEST(RenderReport, OfPosesAloneDoesNotCallThemGood)
{
  const Copy run;
  fs::remove(run / "summary.json");
  const Outcome outcome = runProgram(kRender, {"report", run.path().string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("missing: summary.json"), std::string::npos)
      << outcome.err;
  EXPECT_TRUE(holds(run / "report.html", "\"trusted\":false"));
}

TEST(RenderReport, TakesATitleAndABudget)
{
  const TempFolder folder;
  const fs::path page = folder / "report.html";
  const Outcome outcome = runProgram(kRender,
                                     {"report",
                                      demo().string(),
                                      "-o",
                                      page.string(),
                                      "--title",
                                      "the <b>east</b> wing",
                                      "--max-points",
                                      "1000",
                                      "--quiet"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(holds(page, "the \\u003cb>east\\u003c/b> wing"));
  EXPECT_LT(fs::file_size(page), fs::file_size(demo() / "report.html"));
}

TEST(RenderReport, TellsWhatIsWrong)
{
  const TempFolder folder;
  const std::string file = folder / "file";
  writeText(file, "");
  const auto report = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "report");
    return runProgram(kRender, arguments);
  };
  expectError(report({folder / "nowhere"}), kRender, 1, {"nowhere", "no such folder"});
  expectError(report({folder.path().string()}), kRender, 1, {"holds no run"});
  expectError(
      report({demo().string(), "-o", file + "/report.html"}), kRender, 1, {file});
  expectError(report({demo().string(), "--max-points", "0"}),
              kRender,
              2,
              {"--max-points = 0", "> 0"});
  expectError(report({}), kRender, 2, {"RUN"});
  const Copy run;
  writeText(run / "summary.json", "{\"schema_version\": 1}");
  expectError(report({run.path().string()}), kRender, 1, {"summary.json"});
}

TEST(RenderReport, ReplacesNoFileOfTheRun)
{
  const Copy run;
  for (const char* const file : {"summary.json", "map.pcd"}) {
    const std::string before = readText(run / file), path = run / file;
    expectError(runProgram(kRender, {"report", run.path().string(), "-o", path}),
                kRender,
                2,
                {path, "is an input"});
    EXPECT_EQ(readText(path), before);
  }
}
