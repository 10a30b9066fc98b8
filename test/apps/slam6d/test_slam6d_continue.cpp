// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d --continue: further scans for a finished run.
#include "support/run_program.h"
#include "support/temp_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::runProgram;
using pcl6d::test::TempFolder;

/** A drive of 24 scans, and runs over it without moving all scans at once, so that what
 * is matched stays. */
class Continue : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    folder_ = new TempFolder;
    ASSERT_EQ(runProgram("pcl_slam6d_simulate",
                         {"corridor", "-o", scans(), "--scans", "24", "--quiet"})
                  .exit_code,
              0);
    ASSERT_EQ(slam(scans(), "whole", {}).exit_code, 0);
    ASSERT_EQ(slam(scans(), "part", {"--last", "17"}).exit_code, 0);
  }
  static void
  TearDownTestSuite()
  {
    delete folder_;
    folder_ = nullptr;
  }
  static std::string
  scans()
  {
    return (*folder_ / "scans").string();
  }
  static fs::path
  at(const std::string& name)
  {
    return *folder_ / name;
  }

  static Outcome
  slam(const std::string& input,
       const std::string& out,
       std::vector<std::string> options)
  {
    options.insert(options.begin(),
                   {input,
                    "-o",
                    at(out).string(),
                    "--loop-closing",
                    "none",
                    "--relaxation",
                    "none"});
    return runProgram("pcl_slam6d", options);
  }

  /** Goes on with a copy of the first 18 scans' run. */
  static Outcome
  goOn(const std::string& input,
       const std::string& run,
       std::vector<std::string> options = {})
  {
    if (!fs::exists(at(run)))
      fs::copy(at("part"), at(run), fs::copy_options::recursive);
    options.insert(options.begin(), {input, "--continue", at(run).string()});
    return runProgram("pcl_slam6d", options);
  }

  static TempFolder* folder_;
};
TempFolder* Continue::folder_ = nullptr;
} // namespace

TEST_F(Continue, GivesTheBytesOfOneRunOverAllScans)
{
  const Outcome outcome = goOn(scans(), "grown");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("24 scans, 18 of them registered in"), std::string::npos)
      << outcome.err;
  for (const char* file :
       {"trajectory.kitti", "trajectory.tum", "map.pcd", "scans/scan003.pcd"})
    EXPECT_EQ(readText(at("grown") / file), readText(at("whole") / file)) << file;
  const auto grown = nlohmann::json::parse(readText(at("grown") / "summary.json"));
  const auto whole = nlohmann::json::parse(readText(at("whole") / "summary.json"));
  EXPECT_EQ(grown["scans"], whole["scans"]);
  EXPECT_EQ(grown["options"]["relaxation"]["value"], "none") << "as it was given";
}

TEST_F(Continue, TakesAFolderOfTheFurtherScansAlone)
{
  fs::create_directory(at("further"));
  std::ifstream all(at("scans") / "odometry.txt");
  std::ofstream further(at("further") / "odometry.txt");
  std::string row;
  for (int i = 0; i < 24; ++i) {
    std::getline(all, row);
    if (i < 18)
      continue;
    further << row << '\n';
    const std::string name = "scan0" + std::to_string(i) + ".pcd";
    fs::copy(at("scans") / name, at("further") / name);
  }
  further.close();
  const Outcome outcome = goOn(
      at("further").string(), "joined", {"-o", at("elsewhere").string(), "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(readText(at("elsewhere") / "trajectory.kitti"),
            readText(at("whole") / "trajectory.kitti"));
  EXPECT_EQ(readText(at("joined") / "trajectory.kitti"),
            readText(at("part") / "trajectory.kitti"))
      << "with -o the run itself stays";
}

TEST_F(Continue, MovesAllScansAtOnceIfAskedTo)
{
  const Outcome outcome =
      goOn(scans(), "relaxed", {"--loop-closing", "elch", "--relaxation", "helix"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto summary = nlohmann::json::parse(readText(at("relaxed") / "summary.json"));
  EXPECT_EQ(summary["graph"]["stages"].back()["name"], "relaxation");
  EXPECT_EQ(summary["scans"].size(), 24u);
}

TEST_F(Continue, SaysWhenThereIsNothingFurther)
{
  const Outcome outcome = goOn(scans(), "whole");
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("holds all 24 scans of the folder already"),
            std::string::npos)
      << outcome.err;
}

TEST_F(Continue, RefusesWhatIsNoFinishedRun)
{
  const auto errorOf = [](const Outcome& outcome) {
    EXPECT_EQ(outcome.exit_code, 1);
    return outcome.err;
  };
  const auto names = [](const std::string& error, const std::string& part) {
    EXPECT_NE(error.find(part), std::string::npos) << error;
  };
  names(errorOf(goOn(scans(), "scans")),
        "holds no run of pcl_slam6d (no summary.json)");
  const fs::path file = at("broken") / "summary.json";
  fs::copy(at("part"), at("broken"), fs::copy_options::recursive);
  auto summary = nlohmann::json::parse(readText(file));
  summary["verdict"]["complete"] = false;
  std::ofstream(file) << summary;
  names(errorOf(goOn(scans(), "broken")), "the run was interrupted");
  summary["verdict"]["complete"] = true;
  summary["scans"][1]["state"] = "lost";
  std::ofstream(file) << summary;
  names(errorOf(goOn(scans(), "broken")), "no state of a scan is called 'lost'");
  summary["generator"] = "somebody";
  std::ofstream(file) << summary;
  names(errorOf(goOn(scans(), "broken")), "not of pcl_slam6d");
  std::ofstream(file) << "{";
  names(errorOf(goOn(scans(), "broken")), "line 1: not the syntax of JSON");
}
