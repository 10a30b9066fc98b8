// SPDX-License-Identifier: BSD-3-Clause
// What stands in a report, and that nothing in it breaks the page.
#include "report_run.h"
#include "support/points.h"
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <limits>

namespace {
using nlohmann::json;
using pcl6d::ReportData;
using pcl6d::ReportOptions;
using pcl6d::test::kNan;
using pcl6d::test::kReportOffset;
using pcl6d::test::kWalkerPoints;
using pcl6d::test::makeMovingReport;
using pcl6d::test::makeReportData;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;

constexpr const char* kStart = "<script type=\"application/json\" id=\"run\">";

std::string
pageOf(const ReportData& data, const ReportOptions& options = ReportOptions())
{
  const TempFolder folder;
  pcl6d::writeReport(folder / "report.html", data, options);
  return readText(folder / "report.html");
}

/** \return what the page holds, as a browser finds it: up to the next end of a script */
json
runIn(const std::string& page)
{
  const std::size_t begin = page.find(kStart) + std::strlen(kStart);
  return json::parse(page.substr(begin, page.find("</script", begin) - begin));
}

std::size_t
count(const std::string& text, const std::string& word)
{
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at)
    ++found;
  return found;
}

std::string
bytesOf(const std::string& base64)
{
  const std::string digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned int bits = 0, there = 0;
  for (const char c : base64) {
    if (c == '=')
      break;
    bits = bits << 6 | static_cast<unsigned int>(digits.find(c));
    there += 6;
    if (there >= 8) {
      there -= 8;
      bytes += static_cast<char>(bits >> there & 255U);
    }
  }
  return bytes;
}

/** \return the points of the map of a report, or those of what "moving" */
pcl6d::Points
pointsOf(const json& map, const char* which = "positions")
{
  const std::string bytes = bytesOf(map[which]);
  std::vector<std::uint16_t> steps(bytes.size() / 2);
  std::memcpy(steps.data(), bytes.data(), bytes.size());
  pcl6d::Points points;
  for (std::size_t i = 0; i + 2 < steps.size(); i += 3) {
    Eigen::Vector3d p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = map["origin"][axis].get<double>() +
                map["step"].get<double>() * steps[i + static_cast<std::size_t>(axis)];
    points.push_back(p.cast<float>());
  }
  return points;
}
} // namespace

TEST(Report, TellsWhatTheRunDid)
{
  const json run = runIn(pageOf(makeReportData()));
  EXPECT_EQ(run["title"], "a run");
  EXPECT_FALSE(run["verdict"]["trusted"].get<bool>());
  ASSERT_EQ(run["scans"].size(), 10u);
  const json& last = run["scans"][9];
  EXPECT_EQ(last["state"], "predicted");
  EXPECT_EQ(last["reason"], "overlap below --min-overlap");
  EXPECT_EQ(last["position"], json({18.0, 10.0, 1.0})); // relative to the offset
  EXPECT_DOUBLE_EQ(last["drift"], 1);
  EXPECT_DOUBLE_EQ(last["sigma"], std::sqrt(3e-4));
  EXPECT_DOUBLE_EQ(run["length"], 18);
  EXPECT_EQ(run["links"].size(), 10u);
  EXPECT_EQ(run["links"][9]["reason"], "too few pairs");
  EXPECT_EQ(run["options"][0]["source"], "derived");
  EXPECT_EQ(run["planes"][0]["hull"][2], json({20.0, 20.0, 0.0}));
  EXPECT_EQ(run["objects"][0]["pose"][3], 5.0);
  EXPECT_EQ(run["pictures"][0]["source"].get<std::string>().rfind(
                "data:image/png;base64,", 0),
            0u);
}

TEST(Report, HoldsTheMapToHalfAStep)
{
  const ReportData data = makeReportData();
  const json run = runIn(pageOf(data));
  const pcl6d::Points points = pointsOf(run["map"]);
  ASSERT_EQ(points.size(), data.map.points.size());
  const double step = run["map"]["step"];
  EXPECT_NEAR(step, 20.0 / 65535, 1e-5); // the floor is 20 m long
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_LE((points[i] - data.map.points[i]).cwiseAbs().maxCoeff(),
              0.501 * step + 2e-6)
        << i;
  const std::string scans = bytesOf(run["map"]["scans"]);
  ASSERT_EQ(scans.size(), 2 * points.size());
  EXPECT_EQ(scans.front(), 0);
  EXPECT_EQ(scans[scans.size() - 2], 9); // little-endian
  const std::string grey = bytesOf(run["map"]["intensities"]);
  EXPECT_EQ(static_cast<unsigned char>(grey.front()), 0);
  EXPECT_EQ(static_cast<unsigned char>(grey.back()), 255);
}

TEST(Report, HoldsWhatMovedBesideTheMap)
{
  const ReportData data = makeMovingReport();
  const json run = runIn(pageOf(data));
  EXPECT_EQ(pointsOf(run["map"]).size(), data.map.points.size());
  const pcl6d::Points points = pointsOf(run["map"], "moving");
  ASSERT_EQ(points.size(), kWalkerPoints);
  EXPECT_EQ(run["map"]["moving_total"], kWalkerPoints);
  const double step = run["map"]["step"];
  for (std::size_t i = 0; i < points.size(); ++i)
    ASSERT_LE((points[i] - data.moving.points[i]).cwiseAbs().maxCoeff(),
              0.501 * step + 2e-6)
        << i;
  const json& moving = run["moving"];
  EXPECT_EQ(moving["points"], 40 + 41 + 42 + 43 + 44);
  EXPECT_EQ(moving["measured"], 10045); // 1000 to 1009 points a scan
  EXPECT_EQ(moving["of_scans"][4], 44);
  EXPECT_EQ(moving["of_scans"][5], 0);
  EXPECT_EQ(moving["unknown"], 0.25);
  EXPECT_FALSE(moving["blind"].get<bool>());
  EXPECT_FALSE(moving["removed"].get<bool>());
}

TEST(Report, SaysNothingOfMotionWhereNobodyAskedOrNothingCouldTell)
{
  const json unasked = runIn(pageOf(makeReportData()));
  EXPECT_TRUE(unasked["moving"].is_null());
  EXPECT_FALSE(unasked["map"].contains("moving"));
  ReportData still = makeReportData();
  still.summary.moving.emplace();
  still.summary.moving->points.assign(10, 0);
  const json run = runIn(pageOf(still));
  EXPECT_EQ(run["moving"]["points"], 0);
  EXPECT_FALSE(run["map"].contains("moving"));
  ReportData alone = makeReportData(1);
  alone.summary.moving.emplace();
  alone.summary.moving->points = {0};
  EXPECT_TRUE(runIn(pageOf(alone))["moving"].is_null()); // as the verdict
  still.summary.moving->blind = true;
  still.summary.moving->background = 0.125;
  const json blind = runIn(pageOf(still));
  EXPECT_TRUE(blind["moving"]["blind"].get<bool>());
  EXPECT_EQ(blind["moving"]["background"], 0.125);
}

TEST(Report, ShowsWhatMovedWithoutAMap)
{
  ReportData data = makeMovingReport();
  data.map = {};
  data.moving.points.emplace_back(static_cast<float>(kNan), 0.0F, 0.0F);
  data.moving.scans.push_back(0);
  const json map = runIn(pageOf(data))["map"];
  EXPECT_EQ(map["positions"], "");
  EXPECT_EQ(pointsOf(map, "moving").size(), kWalkerPoints); // NaN has no place
}

TEST(Report, LeavesMostOfItsBudgetToTheMap)
{
  ReportOptions options;
  options.max_points = 1000;
  const json map = runIn(pageOf(makeMovingReport(), options))["map"];
  const std::size_t moving = pointsOf(map, "moving").size();
  EXPECT_LE(moving, 250u);
  EXPECT_GT(moving, 200u);
  EXPECT_LE(pointsOf(map).size() + moving, 1000u);
  EXPECT_GT(pointsOf(map).size() + moving, 900u);
  options.max_points = 3; // no quarter of them is a point
  const json tiny = runIn(pageOf(makeMovingReport(), options))["map"];
  EXPECT_FALSE(tiny.contains("moving"));
  EXPECT_LE(pointsOf(tiny).size(), 3u);
}

TEST(Report, ThinsTheMapToItsBudget)
{
  ReportOptions options;
  options.max_points = 1000;
  const ReportData data = makeReportData();
  const json map = runIn(pageOf(data, options))["map"];
  EXPECT_LE(pointsOf(map).size(), 1000u);
  EXPECT_GT(pointsOf(map).size(), 900u);
  EXPECT_EQ(map["total"], data.map.points.size());
}

TEST(Report, OfACampusStaysBelow15Megabytes)
{
  ReportData data = makeReportData(500);
  while (data.map.points.size() < 500000) {
    data.map.points.insert(
        data.map.points.end(), 100, data.map.points[data.map.points.size() / 2]);
    data.map.scans.insert(data.map.scans.end(), 100, 3);
    data.map.intensities.insert(data.map.intensities.end(), 100, 0.5F);
  }
  data.summary.links.resize(10000, data.summary.links.front());
  data.pictures[0].png.resize(ReportOptions().max_picture_bytes, '\x7f');
  EXPECT_LT(pageOf(data).size(), 15000000u);
}

TEST(Report, LeavesOutNanAndFarPoints)
{
  ReportData data = makeReportData();
  const std::size_t good = data.map.points.size();
  data.map.points.emplace_back(static_cast<float>(kNan), 0.0F, 0.0F);
  data.map.points.emplace_back(0.0F, std::numeric_limits<float>::infinity(), 0.0F);
  data.map.points.emplace_back(0.0F, 1e6F, 0.0F); // would leave one step per 15 m
  data.map.scans.resize(good + 3, 0);
  data.map.intensities.resize(good + 3, static_cast<float>(kNan));
  const json map = runIn(pageOf(data))["map"];
  EXPECT_EQ(pointsOf(map).size(), good);
  EXPECT_LT(map["step"].get<double>(), 0.002);
}

TEST(Report, IsNotBrokenByNames)
{
  const std::string odd =
      "a</script><script>alert(1)</script><!-- \"'&\\ \n\u2028 {{run}}";
  ReportData data = makeReportData();
  data.title = data.summary.scans[1].file = odd;
  data.summary.links[0].rejection = pcl6d::Rejection::stated(odd);
  data.summary.options[0].value = data.objects[0].object_class = odd;
  const std::string page = pageOf(data);
  EXPECT_EQ(count(page, "</script"), count(pageOf(makeReportData()), "</script"));
  EXPECT_EQ(count(page, "<!--"), count(pageOf(makeReportData()), "<!--"));
  const json run = runIn(page);
  EXPECT_EQ(run["title"], odd);
  EXPECT_EQ(run["scans"][1]["file"], odd);
  data.title = "\xff\xfe"; // no UTF-8
  EXPECT_EQ(runIn(pageOf(data))["title"], "\ufffd\ufffd");
}

TEST(Report, HasNoPlaceForPosesThatAreNotNumbers)
{
  ReportData data = makeReportData();
  data.summary.scans[4].T_world_scan.translation().setConstant(kNan);
  data.summary.scans[4].rms = kNan;
  const json run = runIn(pageOf(data));
  EXPECT_TRUE(run["scans"][4]["position"][0].is_null());
  EXPECT_TRUE(run["scans"][4]["rms"].is_null());
  EXPECT_DOUBLE_EQ(run["length"], 14); // the steps to and from it are not known
}

TEST(Report, OfAnEmptyRunOrASinglePointIsWhole)
{
  const json empty = runIn(pageOf(ReportData()));
  EXPECT_EQ(empty["map"]["positions"], "");
  EXPECT_EQ(empty["scans"].size(), 0u);
  ReportData single;
  single.map.points = {{1, 2, 3}};
  const json map = runIn(pageOf(single))["map"];
  EXPECT_GT(map["step"].get<double>(), 0);
  ASSERT_EQ(pointsOf(map).size(), 1u);
  EXPECT_EQ(pointsOf(map)[0], Eigen::Vector3f(1, 2, 3));
}

TEST(Report, IsTheSameEachTime)
{
  EXPECT_EQ(pageOf(makeReportData()), pageOf(makeReportData()));
}

TEST(Report, NeedsNothingFromOutside)
{
  const std::string page = pageOf(makeReportData());
  EXPECT_EQ(count(page, "<script src"), 0u);
  EXPECT_EQ(count(page, "<link rel=\"stylesheet\""), 0u);
  EXPECT_EQ(count(page, "@import"), 0u);
  EXPECT_EQ(count(page, "type=\"module\""), 0u);
  EXPECT_GE(count(page, "SPDX-License-Identifier: MIT"),
            1u); // three.js keeps its licence
}

TEST(Report, TellsWhatIsWrong)
{
  ReportOptions options;
  options.max_points = 0;
  EXPECT_THROW(pageOf(makeReportData(), options), pcl6d::BadArgument);
  ReportData data = makeReportData();
  data.map.scans.pop_back();
  EXPECT_THROW(pageOf(data), pcl6d::BadArgument);
  data = makeMovingReport();
  data.moving.scans.pop_back();
  EXPECT_THROW(pageOf(data), pcl6d::BadArgument);
  data = makeMovingReport();
  data.summary.moving->points.pop_back();
  EXPECT_THROW(pageOf(data), pcl6d::BadArgument);
  const TempFolder folder;
  pcl6d::test::writeText(folder / "file", "");
  EXPECT_THROW(pcl6d::writeReport(folder / "file" / "report.html", makeReportData()),
               pcl6d::IoFailed);
}
