// SPDX-License-Identifier: BSD-3-Clause
// Control points, from the E57 file of a site to poses in their frame.
#include "apps/slam6d/control_site.h"

#include <pcl6d/run/run_summary.h>

#include <gtest/gtest.h>

#include <fstream>

namespace {
using namespace pcl6d::test;
namespace fs = std::filesystem;

/** \brief A run of the site, made once. */
class Slam6dControlPoints : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    folder_ = new TempFolder;
    site_ = new ControlSite(*folder_ / "");
    outcome_ = run(site_->options(),
                   "out",
                   {"--no-picture",
                    "--report",
                    "--project",
                    "project=Hall 4",
                    "--project",
                    "operator=Ada",
                    "--tolerance",
                    "15mm"});
  }
  static void
  TearDownTestSuite()
  {
    delete site_;
    delete folder_;
  }

  static Outcome
  run(const std::vector<std::string>& options,
      const std::string& out,
      const std::vector<std::string>& more)
  {
    std::vector<std::string> arguments = {
        (*folder_ / "site.e57").string(), "-o", (*folder_ / out).string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runProgram("pcl_slam6d", arguments);
  }

  /** Runs with other files of points, and expects one line of error. */
  static void
  expectRefused(const std::string& control,
                const std::string& targets,
                int code,
                const std::string& words)
  {
    SCOPED_TRACE(words);
    std::ofstream(*folder_ / "c.csv") << control;
    std::ofstream(*folder_ / "t.csv") << targets;
    const Outcome outcome = run({"--control",
                                 (*folder_ / "c.csv").string(),
                                 "--targets",
                                 (*folder_ / "t.csv").string()},
                                "refused",
                                {});
    expectError(outcome, "pcl_slam6d", code, {words});
    EXPECT_FALSE(fs::exists(*folder_ / "refused"));
  }

  static inline TempFolder* folder_ = nullptr;
  static inline ControlSite* site_ = nullptr;
  static inline Outcome outcome_;
};

TEST_F(Slam6dControlPoints, CheckPointsAgreeAndTheBlunderIsNamed)
{
  ASSERT_EQ(outcome_.exit_code, 0) << outcome_.err << outcome_.out;
  const auto summary = pcl6d::readRunSummary(*folder_ / "out/summary.json");
  ASSERT_TRUE(summary.control);
  const pcl6d::ControlResult& control = *summary.control;
  ASSERT_TRUE(control.adjusted) << control.reason;
  EXPECT_EQ(control.rejected(), std::vector<std::string>{"T3"});
  // A target and its point are known to 1 mm along each axis: 2.4 mm together. The rms of 18
  // coordinates scatters by a sixth, hence up to 3.7 mm by chance; the scans add a millimetre.
  EXPECT_LT(*control.rms(pcl6d::ControlUse::kCheck), 0.004);
  EXPECT_LT(*control.rms(pcl6d::ControlUse::kControl), 0.003);
  EXPECT_EQ(control.residuals.size(), 18U);
  EXPECT_NE(outcome_.out.find("blunder: control point T3 is "), std::string::npos);
  EXPECT_NE(outcome_.out.find("2 check points (6 targets): rms "), std::string::npos)
      << outcome_.out;
  EXPECT_TRUE(summary.trusted);
}

TEST_F(Slam6dControlPoints, PosesAreInTheFrameOfTheControlPoints)
{
  const auto poses = pcl6d::readTrajectory(*folder_ / "out/trajectory.kitti").poses;
  const auto summary = pcl6d::readRunSummary(*folder_ / "out/summary.json");
  ASSERT_EQ(poses.size(), site_->truth().size());
  double sum = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double error = (site_->truth()[i].inverse() * poses[i]).translation().norm();
    sum += error * error / static_cast<double>(poses.size());
    ASSERT_TRUE(summary.control->bounds[i]);
    EXPECT_LT(error, *summary.control->bounds[i]) << i;
    EXPECT_LT(*summary.control->bounds[i], 0.02) << i;
  }
  EXPECT_LT(std::sqrt(sum), 0.003);
  EXPECT_EQ(std::floor(summary.world_offset.x() / 100), 35123);
  // Points of the map are relative to the offset: float keeps their millimetres.
  const auto map = pcl6d::readScan(*folder_ / "out/map.pcd");
  for (const auto& point : map.points)
    ASSERT_LT(point.norm(), 100);
}

TEST_F(Slam6dControlPoints, TheTableHasARowForEachTarget)
{
  std::ifstream table(*folder_ / "out/control.csv");
  std::string line;
  std::getline(table, line);
  EXPECT_EQ(line, "name,scan,use,dx,dy,dz,length,standardised,detectable");
  std::size_t rows = 0, rejected = 0, checks = 0;
  while (std::getline(table, line)) {
    ++rows;
    rejected += line.find(",rejected,") != std::string::npos ? 1 : 0;
    checks += line.find(",check,") != std::string::npos ? 1 : 0;
    EXPECT_EQ(line.find(",rejected,") != std::string::npos,
              line.rfind("\"T3\",", 0) == 0)
        << line;
  }
  EXPECT_EQ(rows, 18U);
  EXPECT_EQ(rejected, 3U);
  EXPECT_EQ(checks, 6U);
}

TEST_F(Slam6dControlPoints, TheSurveyReportIsWrittenWithTheRun)
{
  const fs::path out = *folder_ / "out";
  for (const char* name : {"survey.html",
                           "survey_requirements.csv",
                           "survey_control.csv",
                           "survey_stations.csv",
                           "survey_links.csv",
                           "survey.xml"})
    EXPECT_TRUE(fs::exists(out / name)) << name;
  const std::string page = readText(out / "survey.html");
  for (const char* words : {"Hall 4",
                            "Ada",
                            "Tolerance 15.0 mm",
                            "Registration accepted with remarks",
                            "Control point T3 has a gross error"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
}

TEST_F(Slam6dControlPoints, TheSurveyReportOfARunHasItsOwnToleranceAndPdf)
{
  const fs::path page = *folder_ / "filed.html";
  const std::string run = (*folder_ / "out").string();
  const Outcome outcome = runProgram(
      "pcl_slam6d_render",
      {"report", run, "--survey", "--tolerance", "0.1mm", "-o", page.string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(readText(page).find("Registration not accepted"), std::string::npos);
  EXPECT_NE(readText(page).find("Hall 4"), std::string::npos); // as the run was told
  expectError(runProgram("pcl_slam6d_render", {"report", run, "--tolerance", "5mm"}),
              "pcl_slam6d_render",
              2,
              {"need --survey"});
  expectError(runProgram("pcl_slam6d_render",
                         {"report", run, "--survey", "--tolerance", "5 inch"}),
              "pcl_slam6d_render",
              2,
              {"tolerance = 5 inch"});
  const Outcome pdf =
      runProgram("pcl_slam6d_render",
                 {"report", run, "--survey", "--pdf", "-o", page.string(), "--quiet"});
  if (pdf.exit_code == 1 && pdf.err.find("Chromium is missing") != std::string::npos)
    GTEST_SKIP() << "no browser: apt-get install chromium";
  ASSERT_EQ(pdf.exit_code, 0) << pdf.err;
  EXPECT_EQ(readText(*folder_ / "filed.pdf").rfind("%PDF-", 0), 0U);
}

TEST_F(Slam6dControlPoints, PointsThatFitNothingAreSaid)
{
  std::ofstream(*folder_ / "else.csv")
      << "T1 0 0 0\nT2 50 0 0\nT3 0 70 0\nT4 20 20 9\nT5 3 1 4\nT6 1 5 9\n";
  const Outcome outcome = run({"--control",
                               (*folder_ / "else.csv").string(),
                               "--targets",
                               (*folder_ / "targets.csv").string()},
                              "else",
                              {"--no-picture"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.out.find("NOT TO BE TRUSTED: not adjusted to the control points"),
            std::string::npos)
      << outcome.out;
  const auto summary = pcl6d::readRunSummary(*folder_ / "else/summary.json");
  EXPECT_FALSE(summary.control->adjusted);
  EXPECT_EQ(summary.world_offset, Eigen::Vector3d(0, 0, 0));
}

TEST_F(Slam6dControlPoints, BadPointsAreRefusedBeforeTheWork)
{
  const std::string three = "A 0 0 0\nB 5 0 0\nC 0 5 0\n";
  const std::string seen = "A 0 1 1 1\nB 1 1 2 1\nC 2 1 3 1\n";
  expectRefused("A 0 0 0\nB 5 0 0\n", seen, 1, "only 2 of 2 have a target");
  expectRefused("A 0 0 0\nB 5 0 0\nC 9 0 0\n", seen, 1, "lie on one line");
  expectRefused(three, "A 77 1 1 1\n", 1, "there is no scan '77'");
  expectRefused(three, seen + "A scan000 1 1 1\n", 1, "is already given in line 1");
  expectRefused("A 0 0 0\nA 5 0 0\n", seen, 1, "is already given in line 1");
  expectRefused(three, "D 0 1 1 1\n", 1, "only 0 of 3 have a target");
  const fs::path control = *folder_ / "control.csv";
  const std::vector<std::vector<std::string>> halves = {{"--control", control.string()},
                                                        {"--targets", control.string()},
                                                        {"--check", "T1"}};
  for (const auto& half : halves)
    expectError(run(half, "refused", {}), "pcl_slam6d", 2, {"needs --"});
  auto options = site_->options();
  options.back() = "T5,T9";
  expectError(run(options, "refused", {}),
              "pcl_slam6d",
              1,
              {"check point T9 is no control point"});
}
} // namespace
