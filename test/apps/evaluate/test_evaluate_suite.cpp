// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_evaluate suite: what it runs, measures, repeats and leaves out.
#include "apps/evaluate/suite_test.h"
#include "apps/support/bad_input.h"
#include "support/folders.h"

#include <pcl6d/benchmarking/relative_error.h>
#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/io/trajectory_io.h>

#include <boost/process.hpp>

#include <csignal>
#include <fstream>
#include <set>
#include <thread>

namespace bp = boost::process;
namespace fs = std::filesystem;
using pcl6d::readTrajectory;
using pcl6d::Trajectory;
using pcl6d::test::contentOf;
using pcl6d::test::CsvRow;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::scans;
using pcl6d::test::SuiteTest;
using pcl6d::test::writeText;

namespace {
void
expectErrors(const CsvRow& row, const Trajectory& estimate)
{
  Trajectory truth = readTrajectory(scans() / "groundtruth.txt");
  truth.poses.resize(4);
  ASSERT_EQ(estimate.poses.size(), 4u);
  const auto errors = evaluateTrajectory(estimate, truth).without_alignment;
  const auto expect = [&](const char* column, double value) {
    EXPECT_EQ(std::stod(row.at(column)), value) << column;
  };
  expect("sigma_position_2d_m", errors.position_2d.rms);
  expect("max_position_2d_m", errors.position_2d.max);
  expect("sigma_yaw_rad", errors.yaw.rms);
  expect("max_yaw_rad", errors.yaw.max);
  expect("rms_position_m", errors.position.rms);
  expect("max_orientation_rad", errors.orientation.max);
  std::vector<pcl6d::PosePair> pairs = {{0, 0}, {1, 1}, {2, 2}, {3, 3}};
  expect("rpe_step_rms_m", stepErrors(estimate, truth, pairs).translation.rms);
}

/** \return the ids of processes that have a word in their command line */
std::set<std::string>
processesWith(const std::string& word)
{
  std::set<std::string> found;
  for (const auto& entry : fs::directory_iterator("/proc"))
    if (readText(entry.path() / "cmdline").find(word) != std::string::npos)
      found.insert(entry.path().filename().string());
  return found;
}

/** Waits until something holds, half a minute at most. */
template <typename Condition>
bool
becomesTrue(const Condition& condition)
{
  for (int i = 0; i < 15000; ++i) {
    if (condition())
      return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}
} // namespace

TEST_F(SuiteTest, MeasuresEveryMethodAndTheOdometry)
{
  const Outcome outcome = run(smallSuite());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  Trajectory odometry = readTrajectory(scans() / "odometry.txt");
  odometry.poses.resize(4);
  expectErrors(rowOf("odometry"), odometry);
  for (const char* method : {"pairwise", "metascan"}) {
    const CsvRow row = rowOf(method);
    Trajectory estimate = readTrajectory(out / "runs" / "corridor" / method / "1" /
                                         "result" / "trajectory.tum");
    expectErrors(row, estimate);
    EXPECT_EQ(row.at("verdict"), "reliable");
    EXPECT_GT(std::stod(row.at("seconds")), 0);
    EXPECT_GT(std::stod(row.at("cpu_seconds")), 0);
    EXPECT_GT(std::stod(row.at("peak_memory_mb")), 10);
    EXPECT_EQ(row.at("runs"), "1");
  }
  EXPECT_EQ(pcl6d::test::readCsv(out / "table.csv").size(), 3u);
  EXPECT_LT(std::stod(rowOf("metascan").at("rms_position_m")),
            std::stod(rowOf("odometry").at("rms_position_m")));
}

TEST_F(SuiteTest, WritesTablesPlotsAndDocument)
{
  const fs::path document = folder / "results.md";
  writeText(document, "# Results\nOf mine.\n");
  const auto suite = smallSuite();
  const Outcome outcome = run(suite, {"--document", document.string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* name :
       {"corridor_paths.png", "corridor_errors.png", "corridor_times.png"})
    EXPECT_EQ(readText(out / name).substr(1, 3), "PNG") << name;
  const std::string table = readText(out / "table.md");
  EXPECT_NE(table.find(outcome.out), std::string::npos) << "the table is printed";
  EXPECT_NE(table.find("--metric=point --metascan=1   # pairwise"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(readText(out / "table.json"))["rows"].size(), 3u);
  EXPECT_FALSE(fs::exists(out / "runs/corridor/pairwise/1/result/scans"));
  const std::string first = readText(document);
  EXPECT_EQ(first.rfind("# Results\nOf mine.\n\n<!-- suite small -->\n", 0), 0u);
  EXPECT_NE(first.find(outcome.out), std::string::npos);
  writeText(document, first + "\nAnd an end.\n");
  run(suite, {"--document", document.string()});
  EXPECT_EQ(readText(document), first + "\nAnd an end.\n") << "put in the same place";
}

TEST_F(SuiteTest, RepeatsOnlyWhatHasChanged)
{
  auto suite = smallSuite();
  suite["repetitions"] = 2;
  ASSERT_EQ(run(suite).exit_code, 0);
  EXPECT_EQ(rowOf("pairwise").at("runs"), "2");
  const std::string pairwise = readText(recordOf("pairwise")),
                    metascan = readText(recordOf("metascan"));
  EXPECT_NE(run(suite).err.find("4 of 4 runs are there already"), std::string::npos);
  suite["methods"]["metascan"]["metascan"] = 2;
  suite["methods"]["further"] = {{"metric", "plane"}};
  ASSERT_EQ(run(suite, {"--only", "pairwise", "metascan"}).exit_code, 0);
  EXPECT_EQ(readText(recordOf("pairwise")), pairwise);
  EXPECT_NE(readText(recordOf("metascan")), metascan);
  EXPECT_FALSE(fs::exists(recordOf("further"))) << "not asked for";
  ASSERT_EQ(run(suite, {"--fresh", "--only", "pairwise"}).exit_code, 0);
  EXPECT_NE(readText(recordOf("pairwise")), pairwise) << "times differ";
}

TEST_F(SuiteTest, GoesOnAfterSigkillWithoutRepeatingFinishedRuns)
{
  auto suite = smallSuite();
  suite["data"]["corridor"]["options"]["last"] = 39;
  suite["methods"]["pairwise"]["last"] = 3;
  writeText(file, suite.dump());
  bp::child program(PCL6D_BIN_DIR "/pcl_slam6d_evaluate",
                    bp::args = {"suite", file.string(), "-o", out.string()},
                    bp::std_out > bp::null,
                    bp::std_err > bp::null);
  const fs::path second = recordOf("metascan").parent_path();
  ASSERT_TRUE(becomesTrue([&] {
    return readText(second / "log.txt").find("matching") != std::string::npos;
  }));
  EXPECT_GE(processesWith(out.string()).size(), 2u) << "the suite and its run";
  ::kill(program.id(), SIGKILL);
  program.wait();
  EXPECT_TRUE(becomesTrue([&] { return processesWith(out.string()).empty(); }))
      << "the run ends with the suite";
  EXPECT_FALSE(fs::exists(second / "run.json")) << "killed in the middle of it";
  const std::string first = readText(recordOf("pairwise"));
  ASSERT_FALSE(first.empty());
  const Outcome outcome = run(suite);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("1 of 2 runs are there already"), std::string::npos);
  EXPECT_EQ(readText(recordOf("pairwise")), first);
  EXPECT_NE(rowOf("metascan").at("rms_position_m"), "");
}

TEST_F(SuiteTest, EndsItsRunsWhenInterrupted)
{
  auto suite = smallSuite();
  suite["data"]["corridor"]["options"]["last"] = 39;
  writeText(file, suite.dump());
  bp::child program(PCL6D_BIN_DIR "/pcl_slam6d_evaluate",
                    bp::args = {"suite", file.string(), "-o", out.string()},
                    bp::std_out > bp::null,
                    bp::std_err > bp::null);
  const fs::path run_folder = recordOf("pairwise").parent_path();
  ASSERT_TRUE(becomesTrue([&] { return fs::exists(run_folder / "log.txt"); }));
  ::kill(program.id(), SIGINT);
  program.wait();
  EXPECT_EQ(program.exit_code(), 130);
  EXPECT_TRUE(processesWith(out.string()).empty());
  EXPECT_FALSE(fs::exists(recordOf("pairwise"))) << "not a run that has ended";
  EXPECT_FALSE(fs::exists(out / "table.csv"));
}

TEST_F(SuiteTest, ARunThatExceedsItsTimeIsARow)
{
  auto suite = smallSuite();
  suite["data"]["corridor"]["options"]["last"] = 39;
  const Outcome outcome = run(suite, {"--time-limit", "0.1", "--only", "metascan"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  const CsvRow row = rowOf("metascan");
  EXPECT_EQ(row.at("verdict"), "timed out");
  EXPECT_EQ(row.at("rms_position_m"), "");
  EXPECT_LT(std::stod(row.at("seconds")), 20);
  const std::string record = readText(recordOf("metascan"));
  run(suite, {"--time-limit", "0.05", "--only", "metascan"});
  EXPECT_EQ(readText(recordOf("metascan")), record) << "less time would not help";
  EXPECT_EQ(run(suite, {"--only", "metascan"}).exit_code, 0) << "more time does";
  EXPECT_NE(rowOf("metascan").at("rms_position_m"), "");
}

TEST_F(SuiteTest, ARunThatFailsIsARowAndTheOthersGoOn)
{
  auto suite = smallSuite();
  fs::create_directory(folder / "broken");
  writeText(folder / "broken" / "scan000.pcd", pcl6d::test::grid());
  writeText(folder / "broken" / "scan001.pcd",
            pcl6d::test::pcd("x y z", 2, "1 2 3\n4 5 6\n"));
  suite["data"]["broken"] = {{"folder", "broken"}}; // from the folder of the suite
  const Outcome outcome = run(suite, {"--only", "pairwise"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  const auto rows = pcl6d::test::readCsv(out / "table.csv");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1].at("verdict"), "reliable");
  EXPECT_EQ(rows[2].at("data"), "broken");
  EXPECT_EQ(rows[2].at("verdict"), "failed (exit 1)");
  EXPECT_NE(rows[2].at("message").find("scan001.pcd: 2 points"), std::string::npos);
  EXPECT_EQ(rows[2].at("rms_position_m"), "");
}

TEST_F(SuiteTest, SimulatesOnceAndAFailedSimulationIsARow)
{
  auto suite = smallSuite();
  suite["data"]["corridor"] = {
      {"simulate", {{"scene", "corridor"}, {"scans", 40}, {"resolution", 4}}},
      {"options", {{"last", 1}}}};
  ASSERT_NE(run(suite, {"--only", "pairwise"}).exit_code, 1);
  EXPECT_EQ(readText(out / "data/corridor/groundtruth.txt").empty(), false);
  const std::string record = readText(out / "data/corridor.json");
  run(suite);
  EXPECT_EQ(readText(out / "data/corridor.json"), record);
  EXPECT_NE(rowOf("odometry").at("rms_position_m"), "");
  const Outcome outcome = run(suite, {"--fresh", "--time-limit", "0.01"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(rowOf("pairwise").at("verdict"), "not run");
  EXPECT_NE(rowOf("pairwise").at("message").find("pcl_slam6d_simulate timed out"),
            std::string::npos);
}

TEST_F(SuiteTest, TellsAMethodThatIsNotReliable)
{
  auto suite = smallSuite();
  suite["methods"]["pairwise"]["iterations"] = 1;
  EXPECT_EQ(run(suite, {"--only", "pairwise"}).exit_code, 0) << "it has numbers";
  EXPECT_EQ(rowOf("pairwise").at("verdict"), "not reliable");
  EXPECT_NE(rowOf("pairwise").at("rms_position_m"), "");
}

TEST_F(SuiteTest, RunsSeveralAtOnce)
{
  EXPECT_EQ(run(smallSuite(), {"--jobs", "2", "--quiet"}).exit_code, 0);
  EXPECT_EQ(rowOf("pairwise").at("verdict"), "reliable");
  EXPECT_EQ(rowOf("metascan").at("verdict"), "reliable");
}

TEST(Suites, AllThatAreShippedAreRight)
{
  const fs::path suites = PCL6D_SOURCE_DIR "/share/suites";
  int count = 0;
  for (const auto& entry : fs::directory_iterator(suites)) {
    const Outcome outcome = pcl6d::test::runProgram(
        "pcl_slam6d_evaluate",
        {"suite", entry.path().string(), "-o", "/dev/null/out", "--quiet"});
    EXPECT_EQ(outcome.exit_code, 1) << "only the output folder is wrong";
    EXPECT_NE(outcome.err.find("/dev/null/out"), std::string::npos) << outcome.err;
    ++count;
  }
  EXPECT_GE(count, 8);
}
