// SPDX-License-Identifier: BSD-3-Clause
#include "report_run.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_links_io.h>
#include <pcl6d/run/run_writer.h>
#include <pcl6d/visualization/survey_report.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

using namespace pcl6d;
using namespace pcl6d::test;

namespace {
/** \return a finished run of four stations with control points */
RunResult
surveyedRun()
{
  RunResult run = makeReportData(4).summary;
  run.trusted = true;
  run.scans.back().state = ScanState::kMatched;
  run.links[0].rms = 0.004;
  run.links[1].rms = 0.003;
  MapVerification& map = run.verification.emplace();
  map.trust = MapTrust::kGood;
  for (std::size_t i = 0; i < 4; ++i) {
    map.scans.emplace_back();
    map.scans.back().tied = true;
    map.scans.back().bound = 0.001 * static_cast<double>(i);
  }
  for (std::size_t i = 1; i < 4; ++i) {
    LinkCheck& check = map.links.emplace_back();
    check.from = i; // the other way round than the link
    check.to = i - 1;
    check.trust = i == 1 ? LinkTrust::kGood : LinkTrust::kWeak;
    check.open_directions = i == 3 ? 2 : 0;
    check.deviation = 0.0005;
  }
  ControlResult& control = run.control.emplace();
  control.adjusted = true;
  control.bounds = {0.002, 0.0025, 0.003, {}};
  for (const auto& [name, use, x] : {std::tuple("T<1>", ControlUse::kControl, 0.001),
                                     std::tuple("T2", ControlUse::kCheck, 0.004)}) {
    ControlResidual& one = control.residuals.emplace_back();
    one.name = name;
    one.use = use;
    one.residual = Eigen::Vector3d(x, 0, 0);
    one.standardised = 1;
  }
  return run;
}

SurveyReport
reportOf(const RunResult& run, const SurveyOptions& options = {})
{
  const TempFolder folder;
  const RunWriter writer(folder / "run", run);
  writer.writePoses();
  PoseGraph graph;
  writer.writeGraph(graph);
  writer.writeVerification();
  writer.writeSummary();
  return surveyOf(RunFolder(folder / "run"), options);
}

const SurveyTable&
tableOf(const SurveyReport& report, const std::string& name)
{
  return *std::find_if(report.tables.begin(),
                       report.tables.end(),
                       [&](const SurveyTable& table) { return table.name == name; });
}

bool
holds(const std::string& text, const std::string& words)
{
  return text.find(words) != std::string::npos;
}
} // namespace

TEST(SurveyReport, HasARowForEachLinkWithItsCheck)
{
  const SurveyReport report = reportOf(surveyedRun());
  const SurveyTable& links = tableOf(report, "links");
  ASSERT_EQ(links.rows.size(), 3U); // the refused one is none
  EXPECT_EQ(links.rows[0][0].text, "scan0");
  EXPECT_EQ(links.rows[0][1].text, "scan1");
  EXPECT_EQ(links.rows[0][2].text, "4.0");
  EXPECT_EQ(links.rows[0][4].text, "50");
  EXPECT_EQ(links.rows[0][5].text, "all fixed");
  EXPECT_EQ(links.rows[0][8].text, "consistent");
  EXPECT_EQ(links.rows[2][5].text, "2 free");
  EXPECT_EQ(links.rows[2][8].text, "inconclusive");
  for (const SurveyTable& table : report.tables)
    for (const auto& row : table.rows)
      EXPECT_EQ(row.size(), table.columns.size()) << table.name;
}

TEST(SurveyReport, StationsHaveFullCoordinatesAndTheBoundOfTheControlFrame)
{
  const SurveyReport report = reportOf(surveyedRun());
  const SurveyTable& stations = tableOf(report, "stations");
  ASSERT_EQ(stations.rows.size(), 4U);
  EXPECT_EQ(stations.rows[1][1].text, "500002.0000");
  EXPECT_EQ(stations.rows[1][2].text, "5400010.0000");
  EXPECT_EQ(stations.rows[1][4].text, "2");
  EXPECT_EQ(stations.rows[1][6].text, "2.5");
  EXPECT_EQ(stations.rows[3][6].text, "-");
  RunResult run = surveyedRun();
  run.control.reset();
  const SurveyReport relative = reportOf(run);
  EXPECT_EQ(tableOf(relative, "stations").rows[3][6].text, "3.0");
}

TEST(SurveyReport, BundleErrorIsThatOfAllPairs)
{
  RunResult run = surveyedRun();
  run.links[0].pairs = 100;
  run.links[0].rms = 0.003;
  run.links[1].pairs = 300;
  run.links[1].rms = 0.005;
  run.links[2].verdict = LinkVerdict::kOdometry; // has no pairs to count
  const SurveyReport report = reportOf(run);
  // sqrt((100 * 9 + 300 * 25) / 400) mm
  EXPECT_EQ(tableOf(report, "requirements").rows[0][1].text, "4.6");
}

TEST(SurveyReport, ToleranceDecides)
{
  RunResult run = surveyedRun();
  run.control->bounds[3] = 0.002;
  EXPECT_EQ(reportOf(run).verdict, SurveyVerdict::kAccepted);
  SurveyOptions options;
  options.tolerance = 0.005;
  const SurveyReport wide = reportOf(run, options);
  EXPECT_EQ(wide.verdict, SurveyVerdict::kAccepted);
  options.tolerance = 0.0035; // the check point is 4 mm off
  const SurveyReport narrow = reportOf(run, options);
  EXPECT_EQ(narrow.verdict, SurveyVerdict::kRejected);
  std::size_t failed = 0;
  for (const auto& row : tableOf(narrow, "requirements").rows)
    failed += row[3].text == "fail" ? 1 : 0;
  EXPECT_EQ(failed, 2U);          // rms and largest
  run.control->bounds[3].reset(); // a station that nothing bounds meets no tolerance
  options.tolerance = 0.005;
  EXPECT_EQ(reportOf(run, options).verdict, SurveyVerdict::kRejected);
}

TEST(SurveyReport, VerdictFollowsVerificationAndControl)
{
  RunResult run = surveyedRun();
  run.control->residuals[0].use = ControlUse::kRejected;
  const SurveyReport blunder = reportOf(run);
  EXPECT_EQ(blunder.verdict, SurveyVerdict::kConditional);
  EXPECT_TRUE(holds(blunder.reasons[0], "Control point T<1> has a gross error"));
  run = surveyedRun();
  run.verification->trust = MapTrust::kDoubtful;
  run.verification->doubts = {pcl6d::RejectReason::kScansContradict};
  run.trusted = false;
  EXPECT_EQ(reportOf(run).verdict, SurveyVerdict::kRejected);
  run = surveyedRun();
  run.verification->trust = MapTrust::kUnverified;
  run.verification->doubts = {pcl6d::RejectReason::kScansNotVerified};
  EXPECT_EQ(reportOf(run).verdict, SurveyVerdict::kConditional);
  run = surveyedRun();
  run.control->adjusted = false;
  run.control->reason = "they fit nothing";
  run.trusted = false;
  EXPECT_EQ(reportOf(run).verdict, SurveyVerdict::kRejected);
}

TEST(SurveyReport, OverlapMatrixIsSymmetricAndEmptyWithoutLink)
{
  const SurveyReport report = reportOf(surveyedRun());
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const bool is_linked = i + 1 == j || j + 1 == i;
      EXPECT_EQ(std::isfinite(report.overlaps[i][j]), is_linked);
      if (is_linked) {
        EXPECT_EQ(report.overlaps[i][j], 0.5);
        EXPECT_EQ(report.overlaps[j][i], 0.5);
      }
    }
  EXPECT_EQ(report.link_errors.size(), 3U);
}

TEST(SurveyReport, PageEscapesWhatTheUserGives)
{
  SurveyOptions options = surveyOptionsFrom(
      {"project=Hall <4> & \"yard\"", "operator=Ada\ninstrument=X 360", "floor=2"},
      "5mm");
  const SurveyReport report = reportOf(surveyedRun(), options);
  const TempFolder folder;
  writeSurveyReport(folder / "survey.html", report);
  const std::string page = readText(folder / "survey.html");
  for (const char* words : {"Hall &lt;4&gt; &amp; &quot;yard&quot;",
                            "<td>Ada</td>",
                            "<td>X 360</td>",
                            "<td>floor</td><td>2</td>",
                            "@page",
                            "size: A4",
                            "T&lt;1&gt;",
                            "Overlap matrix",
                            "Histogram"})
    EXPECT_TRUE(holds(page, words)) << words;
  EXPECT_FALSE(holds(page, "<script"));
  EXPECT_FALSE(holds(page, "Hall <4>"));
}

TEST(SurveyReport, TablesAreWrittenAsCsvAndXml)
{
  RunResult run = surveyedRun();
  run.scans[0].file = "hall, west.pcd";
  const SurveyReport report = reportOf(run);
  const TempFolder folder;
  const auto files = writeSurveyTables(folder / "site", report);
  ASSERT_EQ(files.size(), 5U);
  EXPECT_EQ(files.back().filename(), "site.xml");
  const std::string stations = readText(folder / "site_stations.csv");
  EXPECT_TRUE(holds(stations, "station,X [m],Y [m],Z [m],links,"));
  EXPECT_TRUE(holds(stations, "\n\"hall, west\",500000.0000,5400010.0000,"));
  EXPECT_EQ(std::count(stations.begin(), stations.end(), '\n'), 5);
  const std::string xml = readText(folder / "site.xml");
  EXPECT_EQ(xml.rfind("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<surveyReport ", 0),
            0U);
  EXPECT_TRUE(holds(xml, "<value name=\"point\">T&lt;1&gt;</value>"));
  EXPECT_TRUE(holds(xml, "</surveyReport>"));
}

TEST(SurveyOptions, LengthsHaveUnits)
{
  EXPECT_DOUBLE_EQ(*surveyOptionsFrom({}, "5mm").tolerance, 0.005);
  EXPECT_DOUBLE_EQ(*surveyOptionsFrom({}, "0.5 cm").tolerance, 0.005);
  EXPECT_DOUBLE_EQ(*surveyOptionsFrom({}, "0.005m").tolerance, 0.005);
  EXPECT_DOUBLE_EQ(*surveyOptionsFrom({}, "0.005").tolerance, 0.005);
  EXPECT_FALSE(surveyOptionsFrom({}, "").tolerance);
  for (const char* word : {"5 inch", "mm", "-5mm", "0", "nan", "inf", "5mm5"})
    EXPECT_THROW(surveyOptionsFrom({}, word), BadArgument) << word;
  EXPECT_THROW(surveyOptionsFrom({"no key"}, ""), BadArgument);
  EXPECT_THROW(surveyOptionsFrom({"=value"}, ""), BadArgument);
}

TEST(SurveyReport, NamesTheCoordinateSystem)
{
  const auto systemOf = [](const RunResult& run, const SurveyOptions& options = {}) {
    const auto header = reportOf(run, options).header;
    const auto row = std::find_if(header.begin(), header.end(), [](const auto& entry) {
      return entry.first == "Coordinate system";
    });
    return row == header.end() ? std::string() : row->second;
  };
  RunResult run = surveyedRun();
  EXPECT_EQ(systemOf(run), "frame of the control points");
  run.options.push_back({"epsg", "0", "default", ""}); // not known
  EXPECT_EQ(systemOf(run), "frame of the control points");
  run.options.back().value = "25832";
  EXPECT_EQ(systemOf(run), "EPSG:25832");
  SurveyOptions options;
  options.project = {{"coordinate-system", "site grid"}};
  EXPECT_EQ(systemOf(run, options), "site grid");
}
