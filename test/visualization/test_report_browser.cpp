// SPDX-License-Identifier: BSD-3-Clause
// The page in a browser, and the page as npm makes it.
#include "report_run.h"
#include "support/browser.h"
#include "support/folders.h"

#include <boost/process.hpp>
#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

namespace {
namespace fs = std::filesystem;
using pcl6d::ReportData;
using pcl6d::test::expectPassed;
using pcl6d::test::findBrowser;
using pcl6d::test::isChecked;
using pcl6d::test::makeMovingReport;
using pcl6d::test::makeReportData;
using pcl6d::test::readText;
using pcl6d::test::selfTestOf;
using pcl6d::test::TempFolder;

class ReportInABrowser : public testing::Test {
protected:
  void
  SetUp() override
  {
    if (findBrowser().empty())
      GTEST_SKIP() << "no browser: apt-get install chromium";
  }

  fs::path
  write(const ReportData& data) const
  {
    pcl6d::writeReport(folder_ / "report.html", data);
    return folder_ / "report.html";
  }

  nlohmann::json
  open(const ReportData& data, int width, int height) const
  {
    return selfTestOf(write(data), width, height);
  }

private:
  TempFolder folder_;
};

/** \return what a check of the page found */
std::string
detailOf(const nlohmann::json& outcome, const std::string& name)
{
  for (const auto& check : outcome["checks"])
    if (check["name"] == name)
      return check["detail"];
  return "no check " + name;
}

bool
isThere(const std::string& program)
{
  return !boost::process::search_path(program).empty();
}

/** \return whether npm could not reach its registry */
bool
hasNoNetwork(const std::string& log)
{
  for (const char* const code : {"ENOTFOUND",
                                 "EAI_AGAIN",
                                 "ECONNREFUSED",
                                 "ECONNRESET",
                                 "ETIMEDOUT",
                                 "ENETUNREACH",
                                 "ERR_SOCKET_TIMEOUT"})
    if (log.find(code) != std::string::npos)
      return true;
  return false;
}
} // namespace

TEST_F(ReportInABrowser, WorksOnADesktop)
{
  const auto outcome = open(makeReportData(), 1280, 900);
  expectPassed(outcome);
  EXPECT_EQ(outcome["width"], 1280);
  for (const char* const layer :
       {"map", "trajectory", "initial", "links", "planes", "objects", "grid"})
    EXPECT_TRUE(isChecked(outcome, "layer " + std::string(layer) + " can be switched"))
        << layer;
  EXPECT_FALSE(isChecked(outcome, "layer moving can be switched"));
  EXPECT_EQ(detailOf(outcome, "what moved is told"), ""); // nobody asked
}

TEST_F(ReportInABrowser, ShowsWhatMovedInRedAndSwitchesIt)
{
  for (const auto& [width, height] : {std::pair(1280, 900), {390, 844}}) {
    SCOPED_TRACE(width);
    const auto outcome = open(makeMovingReport(), width, height);
    expectPassed(outcome);
    EXPECT_TRUE(isChecked(outcome, "layer moving can be switched"));
    EXPECT_TRUE(isChecked(outcome, "what moved is red"));
    const std::string text = detailOf(outcome, "what moved is told");
    for (const char* const words : {"210 points moved (2.1 %), in 5 scans",
                                    "red in the map",
                                    "25 % of the places were seen by no other scan"})
      EXPECT_NE(text.find(words), std::string::npos) << words << " in: " << text;
  }
}

TEST_F(ReportInABrowser, TellsThatNothingMovedOrWhyThatIsNotKnown)
{
  ReportData data = makeReportData();
  data.summary.moving.emplace();
  data.summary.moving->points.assign(10, 0);
  const auto still = open(data, 800, 600);
  expectPassed(still);
  EXPECT_EQ(detailOf(still, "what moved is told").rfind("Nothing moved.", 0), 0u);
  EXPECT_FALSE(isChecked(still, "layer moving can be switched"));
  data.summary.moving->blind = true;
  data.summary.moving->background = 0.125;
  const auto blind = open(data, 800, 600);
  expectPassed(blind);
  const std::string text = detailOf(blind, "what moved is told");
  EXPECT_NE(text.find("contradict 12.5 % of the points"), std::string::npos) << text;
}

TEST_F(ReportInABrowser, WorksOnAPhoneWithOddNames)
{
  ReportData data = makeReportData(300);
  const std::string odd = "</script><b onclick=\"x\">'&" + std::string(80, 'w');
  data.title = data.summary.scans[1].file = odd;
  data.summary.links[0].rejection = pcl6d::Rejection::stated(odd);
  data.summary.scans[4].T_world_scan.translation().setConstant(
      std::numeric_limits<double>::quiet_NaN());
  const auto outcome = open(data, 390, 844);
  expectPassed(outcome);
  EXPECT_EQ(outcome["width"], 390);
}

TEST_F(ReportInABrowser, ShowsARunWithoutMap)
{
  ReportData data = makeReportData();
  data.map = {};
  data.planes = {};
  data.objects = {};
  data.missing = {"missing: map.pcd (the run was interrupted)"};
  const auto outcome = open(data, 800, 600);
  expectPassed(outcome);
  EXPECT_FALSE(isChecked(outcome, "layer map can be switched"));
}

TEST_F(ReportInABrowser, RunsNoScriptButItsOwn) // whatever got into the page
{
  const fs::path file = write(makeReportData());
  std::string page = readText(file);
  page.insert(page.find("<div id=\"report\">"),
              "<script>window.pageErrors.push('a stranger ran');</script>"
              "<b onclick=\"x\" onfocus=\"pageErrors.push('so did this')\" "
              "autofocus tabindex=\"0\">b</b>");
  pcl6d::test::writeText(file, page);
  expectPassed(selfTestOf(file, 800, 600));
  const std::string rule = "http-equiv=\"Content-Security-Policy\"";
  page.erase(page.find(rule), rule.size()); // without the policy the test would notice
  pcl6d::test::writeText(file, page);
  EXPECT_NE(selfTestOf(file, 800, 600).dump().find("a stranger ran"),
            std::string::npos);
}

TEST(ReportPage, IsWhatNpmMakesOfItsSources)
{
  for (const char* const program : {"node", "npm"})
    if (!isThere(program))
      GTEST_SKIP() << "no " << program << ": apt-get install nodejs npm";
  const fs::path source = fs::path(PCL6D_SOURCE_DIR) / "modules/visualization/report";
  const TempFolder folder;
  for (const char* const file : {"package.json", "package-lock.json", "build.js"})
    fs::copy(source / file, folder / file);
  fs::copy(source / "src", folder / "src", fs::copy_options::recursive);
  const std::string command = "cd '" + folder.path().string() +
                              "' && npm ci --no-audit --no-fund > log 2>&1 && npm run "
                              "build >> log 2>&1";
  const int code = std::system(command.c_str());
  const std::string log = readText(folder / "log");
  if (code != 0 && hasNoNetwork(log))
    GTEST_SKIP() << "npm does not reach its registry";
  ASSERT_EQ(code, 0) << log;
  EXPECT_TRUE(readText(folder / "report_page.html") ==
              readText(source / "report_page.html"))
      << "run `npm ci && npm run build` in " << source;
}
