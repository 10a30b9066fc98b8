// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/benchmarking/suite_table.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

using pcl6d::SuiteRow;
using pcl6d::Trajectory;

namespace {
/** Poses on the x axis, shifted and turned about z. */
Trajectory
path(const std::vector<double>& shifts, double yaw)
{
  Trajectory trajectory;
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() << static_cast<double>(i), shifts[i], 0;
    pose.linear() << std::cos(yaw), -std::sin(yaw), 0, std::sin(yaw), std::cos(yaw), 0,
        0, 0, 1;
    trajectory.poses.push_back(pose);
  }
  return trajectory;
}

/** Errors of 0, 3 and 4 m: rms sqrt(25 / 3); the yaw is off by 0.01 rad. The two steps are
 * (1.0299, 2.9899) and (0.9300, -7.0097) instead of (1, 0), by hand, so the rms of their
 * errors is 5.3889; both together miss 4.0200 m, asked for over 1.5 m. */
SuiteRow
measured()
{
  SuiteRow row;
  row.data = "street";
  row.method = "A";
  const Trajectory estimate = path({0, 3, -4}, 0.01), truth = path({0, 0, 0}, 0);
  row.errors = evaluateTrajectory(estimate, truth);
  row.steps = stepErrors(estimate, truth, row.errors->matching.pairs);
  row.drift = driftErrors(estimate, truth, row.errors->matching.pairs, {1.5});
  row.agreement = 0.5;
  row.seconds = 12.345;
  row.cpu_seconds = 20;
  row.peak_memory_mb = 99.6;
  row.runs = 1;
  row.verdict = "reliable";
  return row;
}

SuiteRow
failed()
{
  SuiteRow row;
  row.data = "street";
  row.method = "B|C, \"D\"";
  row.seconds = 0.25;
  row.runs = 1;
  row.verdict = "failed (exit 1)";
  row.message = "scan1.pcd: broken, alas";
  return row;
}
} // namespace

TEST(SuiteTable, MarkdownHasTheBooksMeasuresInMetresAndDegrees)
{
  EXPECT_EQ(
      pcl6d::suiteMarkdown({measured(), failed()}),
      "| method | sigma pos [m] | max pos [m] | sigma yaw [deg] | max yaw [deg] | "
      "3D rms [m] | RPE/step [m] | drift [%] | agreement | time [s] | memory [MB] | "
      "verdict |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|\n"
      "| A | 2.887 | 4.000 | 0.573 | 0.573 | 2.887 | 5.3889 | 268.000 | 0.500 | "
      "12.3 | 100 | reliable |\n"
      "| B\\|C, \"D\" | - | - | - | - | - | - | - | - | 0.2 | - | failed (exit 1) |\n"
      "\n- B|C, \"D\": scan1.pcd: broken, alas\n");
}

TEST(SuiteTable, MarkdownNamesTheDataWhereTheyDifferAndLeavesOutEmptyColumns)
{
  SuiteRow first, second;
  first.data = "street";
  second.data = "square";
  first.method = second.method = "A";
  first.seconds = second.seconds = 1;
  second.message = "why";
  EXPECT_EQ(pcl6d::suiteMarkdown({first, second}),
            "| data | method | time [s] | verdict |\n"
            "|---|---|---|---|\n"
            "| street | A | 1.0 | - |\n"
            "| square | A | 1.0 | - |\n"
            "\n- square, A: why\n");
}

TEST(SuiteTable, CsvHasAllColumnsWithEveryDigitAndQuotesTexts)
{
  auto row = measured();
  const auto& errors = row.errors->without_alignment;
  const std::string text = pcl6d::suiteCsv({row, failed()});
  const auto line = [&](int number) {
    std::size_t begin = 0;
    for (int i = 0; i < number; ++i)
      begin = text.find('\n', begin) + 1;
    return text.substr(begin, text.find('\n', begin) - begin);
  };
  EXPECT_EQ(
      line(0),
      "data,method,sigma_position_2d_m,max_position_2d_m,sigma_yaw_rad,max_yaw_rad,"
      "rms_position_m,max_position_m,rms_orientation_rad,max_orientation_rad,"
      "rpe_step_rms_m,rpe_step_rms_rad,drift_per_metre,drift_rad_per_metre,"
      "agreement,seconds,cpu_seconds,peak_memory_mb,runs,verdict,message");
  EXPECT_EQ(line(1).substr(0, 9), "street,A,");
  EXPECT_EQ(std::stod(line(1).substr(9)), errors.position_2d.rms) << "all digits";
  EXPECT_NE(line(1).find(",0.5,12.345,20.0,99.6,1,reliable,"), std::string::npos);
  EXPECT_EQ(line(2),
            "street,\"B|C, \"\"D\"\"\",,,,,,,,,,,,,,0.25,,,1,failed (exit 1),"
            "\"scan1.pcd: broken, alas\"");
}

TEST(SuiteTable, JsonHasNullWhereThereIsNoNumber)
{
  const auto row = measured();
  const auto json = nlohmann::json::parse(pcl6d::suiteJson({row, failed()}));
  EXPECT_EQ(json["schema_version"], 1);
  ASSERT_EQ(json["rows"].size(), 2u);
  const auto& good = json["rows"][0];
  EXPECT_DOUBLE_EQ(good["sigma_position_2d_m"], std::sqrt(25.0 / 3));
  EXPECT_DOUBLE_EQ(good["max_position_2d_m"], 4);
  EXPECT_NEAR(good["sigma_yaw_rad"], 0.01, 1e-15);
  EXPECT_EQ(good["with_alignment"]["position"]["rms"],
            row.errors->with_alignment.position.rms);
  EXPECT_EQ(good["verdict"], "reliable");
  const auto& bad = json["rows"][1];
  EXPECT_TRUE(bad["sigma_position_2d_m"].is_null());
  EXPECT_TRUE(bad["with_alignment"].is_null());
  EXPECT_TRUE(bad["peak_memory_mb"].is_null());
  EXPECT_EQ(bad["message"], "scan1.pcd: broken, alas");
}

TEST(SuiteTable, WithoutRowsThereIsAHeadOnly)
{
  EXPECT_EQ(pcl6d::suiteMarkdown({}), "| method | verdict |\n|---|---|\n");
  EXPECT_EQ(nlohmann::json::parse(pcl6d::suiteJson({}))["rows"].size(), 0u);
}
