// SPDX-License-Identifier: BSD-3-Clause
// Control points in the files of a run: summary.json, control.csv, verdict.
#include "io/io_test.h"
#include "support/temp_folder.h"

#include <pcl6d/run/control_table.h>
#include <pcl6d/run/run_links_io.h>
#include <pcl6d/run/run_summary.h>

#include <cmath>
#include <fstream>
#include <limits>

using pcl6d::ControlResidual;
using pcl6d::ControlUse;
using pcl6d::IoFailed;
using pcl6d::RunResult;
using pcl6d::test::messageOf;
using pcl6d::test::readText;
using pcl6d::test::replaceText;
using pcl6d::test::TempFolder;

namespace {
RunResult
adjustedRun()
{
  RunResult run;
  run.generator = "pcl_slam6d";
  for (int i = 0; i < 2; ++i) {
    run.scans.emplace_back();
    run.scans.back().file = "scan00" + std::to_string(i) + ".pcd";
    run.scans.back().index = 3 + i;
    run.scans.back().state = pcl6d::ScanState::kMatched;
  }
  pcl6d::ControlResult& control = run.control.emplace();
  control.adjusted = true;
  control.T_control_initial.translation() = Eigen::Vector3d(3512345, 5412345, 431);
  control.variance_factor = 1.25;
  control.largest_change = 0.003;
  control.bounds = {0.004, {}};
  control.without_target = {"far"};
  control.without_control = {"unknown"};
  const auto add = [&](const char* name, std::size_t scan, ControlUse use, double x) {
    ControlResidual& one = control.residuals.emplace_back();
    one.name = name;
    one.scan = scan;
    one.use = use;
    one.residual = Eigen::Vector3d(x, 0, 0);
    one.standardised = 1000 * x;
    one.detectable =
        use == ControlUse::kControl ? 0.01 : std::numeric_limits<double>::infinity();
  };
  add("A", 0, ControlUse::kControl, 0.001);
  add("A", 1, ControlUse::kRejected, 0.05);
  add("B, \"b\"", 0, ControlUse::kCheck, -0.003);
  add("C", 1, ControlUse::kRejected, 0.2);
  return run;
}
} // namespace

TEST(ControlTable, IsReadBackFromTheSummary)
{
  const TempFolder folder;
  const RunResult run = adjustedRun();
  pcl6d::writeRunSummary(folder / "summary.json", run);
  const RunResult again = pcl6d::readRunSummary(folder / "summary.json");
  ASSERT_TRUE(again.control);
  const pcl6d::ControlResult& control = *again.control;
  EXPECT_TRUE(control.adjusted);
  EXPECT_EQ(control.T_control_initial.matrix(),
            run.control->T_control_initial.matrix());
  EXPECT_EQ(control.variance_factor, 1.25);
  EXPECT_EQ(control.largest_change, 0.003);
  EXPECT_EQ(control.bounds, run.control->bounds);
  EXPECT_EQ(control.without_target, run.control->without_target);
  EXPECT_EQ(control.without_control, run.control->without_control);
  ASSERT_EQ(control.residuals.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(control.residuals[i].name, run.control->residuals[i].name);
    EXPECT_EQ(control.residuals[i].use, run.control->residuals[i].use);
    EXPECT_EQ(control.residuals[i].scan, run.control->residuals[i].scan);
    EXPECT_EQ(control.residuals[i].residual, run.control->residuals[i].residual);
    EXPECT_EQ(control.residuals[i].detectable, run.control->residuals[i].detectable);
  }
  EXPECT_EQ(*control.rms(ControlUse::kControl), 0.001);
  EXPECT_FALSE(control.rms(ControlUse::kUnused));
}

TEST(ControlTable, BrokenSummariesAreRefusedByPlaceAndRule)
{
  const TempFolder folder;
  pcl6d::writeRunSummary(folder / "summary.json", adjustedRun());
  const std::string whole = readText(folder / "summary.json");
  const auto refusal = [&](const std::string& from, const std::string& to) {
    std::string broken = whole;
    const std::size_t at = broken.find(from, broken.find("\"control\": {"));
    EXPECT_NE(at, std::string::npos) << from;
    broken.replace(at, from.size(), to);
    replaceText(folder / "broken.json", broken);
    return messageOf<IoFailed>([&] { pcl6d::readRunSummary(folder / "broken.json"); });
  };
  EXPECT_NE(refusal("\"scan\": 1", "\"scan\": 2").find("the place of a scan"),
            std::string::npos);
  EXPECT_NE(refusal("\"use\": \"check\"", "\"use\": \"cheek\"").find("cheek"),
            std::string::npos);
  EXPECT_NE(refusal("0.004,", "0.004, 0.1,").find("one per scan"), std::string::npos);
}

TEST(ControlTable, HasARowForEachTarget)
{
  const TempFolder folder;
  pcl6d::writeControlTable(folder / "control.csv", adjustedRun());
  EXPECT_EQ(readText(folder / "control.csv"),
            "name,scan,use,dx,dy,dz,length,standardised,detectable\n"
            "\"A\",3,control,0.001000,0.000000,0.000000,0.001000,1.000,0.010000\n"
            "\"A\",4,rejected,0.050000,0.000000,0.000000,0.050000,50.000,\n"
            "\"B, \"\"b\"\"\",3,check,-0.003000,0.000000,0.000000,0.003000,-3.000,\n"
            "\"C\",4,rejected,0.200000,0.000000,0.000000,0.200000,200.000,\n");
}

TEST(ControlTable, WordsNameBlundersAndDoubts)
{
  RunResult run = adjustedRun();
  const std::string words = pcl6d::controlWords(run);
  for (const char* part : {"1 control point (1 target): rms 1.0 mm, largest 1.0 mm",
                           "1 check point (1 target): rms 3.0 mm",
                           "blunder: target A in scan001.pcd is 50.0 mm off",
                           "blunder: control point C is 200 mm off",
                           "control points without a target: far",
                           "targets without a control point: unknown"})
    EXPECT_NE(words.find(part), std::string::npos) << words;
  run.control->doubt = "one of A, B is wrong";
  EXPECT_NE(pcl6d::controlWords(run).find("NOT TO BE TRUSTED: one of A, B is wrong"),
            std::string::npos);
  run.control->adjusted = false;
  run.control->reason = "they fit nothing";
  EXPECT_NE(
      pcl6d::controlWords(run).find("not adjusted to the control points: they fit"),
      std::string::npos);
  run.control.reset();
  EXPECT_EQ(pcl6d::controlWords(run), "");
}

TEST(ControlTable, InitialPosesFollowToTheControlFrame)
{
  RunResult run = adjustedRun();
  run.scans[1].initial_pose.translation() = Eigen::Vector3d(1, 2, 3);
  EXPECT_EQ(pcl6d::initialPoseOf(run, 1).translation(),
            Eigen::Vector3d(3512346, 5412347, 434));
  run.control.reset();
  EXPECT_EQ(pcl6d::initialPoseOf(run, 1).translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(LinkChecks, AreReadAsTheyWereWritten)
{
  const TempFolder folder;
  std::vector<pcl6d::LinkCheck> links(2);
  links[0].from = 1;
  links[0].to = 4;
  links[0].trust = pcl6d::LinkTrust::kGood;
  links[0].probability_wrong = 0.125;
  links[0].patches = 320;
  links[0].contradicted = 2;
  links[0].deviation = 0.0015;
  links[0].noticed.emplace();
  links[0].noticed->least = 0.02;
  links[0].noticed->most = 0.08;
  links[0].noticed->turn = 0.001;
  links[1].trust = pcl6d::LinkTrust::kWrong;
  links[1].open_directions = 2;
  links[1].rejection = pcl6d::Rejection::stated("rays, contradict");
  pcl6d::writeLinkChecks(folder / "verification.csv", links);
  const auto read = pcl6d::readLinkChecks(folder / "verification.csv");
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].to, 4U);
  EXPECT_EQ(read[0].trust, pcl6d::LinkTrust::kGood);
  EXPECT_EQ(read[0].probability_wrong, 0.125);
  EXPECT_EQ(read[0].patches, 320U);
  EXPECT_EQ(read[0].contradicted, 2U);
  EXPECT_EQ(read[0].deviation, 0.0015);
  ASSERT_TRUE(read[0].noticed);
  EXPECT_EQ(read[0].noticed->most, 0.08);
  EXPECT_FALSE(read[1].noticed);
  EXPECT_EQ(read[1].open_directions, 2);
  EXPECT_EQ(read[1].rejection, links[1].rejection);
  replaceText(folder / "broken.csv",
              "from,to,trust,shift,deviation,open_directions\n"
              "0,1,best,0,0,0\n");
  EXPECT_NE(messageOf<IoFailed>([&] {
              pcl6d::readLinkChecks(folder / "broken.csv");
            }).find("line 2"),
            std::string::npos);
}
