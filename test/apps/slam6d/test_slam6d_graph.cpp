// SPDX-License-Identifier: BSD-3-Clause
// Loops, relaxation and given links of pcl_slam6d.
#include "support/run_program.h"
#include "support/temp_folder.h"

#include <pcl6d/io/pose_graph_io.h>
#include <pcl6d/io/trajectory_io.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>

namespace {
namespace fs = std::filesystem;
using pcl6d::test::readText;
using pcl6d::test::runProgram;
using pcl6d::test::TempFolder;

/** A corridor with a closed way, matched pairwise so that it drifts. */
class Graph : public testing::Test {
protected:
  static void
  SetUpTestSuite()
  {
    folder_ = new TempFolder;
    const auto outcome = runProgram(
        "pcl_slam6d_simulate",
        {"corridor", "-o", (*folder_ / "scans").string(), "--scans", "40", "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  static void
  TearDownTestSuite()
  {
    delete folder_;
    folder_ = nullptr;
  }

  static pcl6d::test::Outcome
  run(const std::string& name, std::vector<std::string> options)
  {
    options.insert(options.begin(),
                   {(*folder_ / "scans").string(), "-o", (*folder_ / name).string()});
    return runProgram("pcl_slam6d", options);
  }

  static double
  positionRms(const std::string& name)
  {
    const auto found =
        pcl6d::readTrajectory(*folder_ / name / "trajectory.kitti").poses;
    const auto truth =
        pcl6d::readTrajectory(*folder_ / "scans" / "groundtruth.txt").poses;
    double sum = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
      sum += (found[i].translation() - truth[i].translation()).squaredNorm();
    return std::sqrt(sum / static_cast<double>(found.size()));
  }

  static TempFolder* folder_;
};
TempFolder* Graph::folder_ = nullptr;

} // namespace

TEST_F(Graph, RelaxationBringsTheLoopTogether)
{
  ASSERT_EQ(
      run("matched", {"--loop-closing", "none", "--relaxation", "none"}).exit_code, 0);
  const auto outcome = run("relaxed", {});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("relaxation: agreement"), std::string::npos)
      << outcome.out;
  EXPECT_LT(positionRms("relaxed"), 0.9 * positionRms("matched"));
  EXPECT_LT(positionRms("relaxed"), 0.02);

  const fs::path out = *folder_ / "relaxed";
  const pcl6d::PoseGraph graph = pcl6d::readPoseGraph(out / "graph.g2o");
  EXPECT_EQ(graph.poses.size(), 40u);
  EXPECT_GE(graph.links.size(), 40u);
  const auto summary = nlohmann::json::parse(readText(out / "summary.json"));
  EXPECT_EQ(summary["graph"]["stages"].back()["name"], "relaxation");
  EXPECT_FALSE(summary["graph"]["stages"].back()["reverted"].get<bool>());
  EXPECT_TRUE(summary["graph"]["disconnected"].empty());
  EXPECT_EQ(readText(out / "links.csv").substr(0, 27), "from,to,kind,verdict,reason");
}

TEST_F(Graph, TheSameBytesForAnyNumberOfThreads)
{
  std::string first;
  for (const char* threads : {"1", "2", "8"}) {
    const auto outcome = run("threads", {"--force", "--threads", threads});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string poses = readText(*folder_ / "threads" / "trajectory.kitti") +
                              readText(*folder_ / "threads" / "links.csv");
    if (first.empty())
      first = poses;
    EXPECT_EQ(poses, first) << threads;
  }
}

TEST_F(Graph, AWrongGivenLinkMovesNothing)
{
  std::ofstream(*folder_ / "wrong.txt") << "# opposite sides\n0 20\n";
  ASSERT_EQ(run("plain", {}).exit_code, 0);
  const auto outcome = run("wrong", {"--graph-in", (*folder_ / "wrong.txt").string()});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NEAR(positionRms("wrong"), positionRms("plain"), 0.01);
  EXPECT_NE(readText(*folder_ / "wrong" / "links.csv").find("0,20,given,refused"),
            std::string::npos);
}

TEST_F(Graph, BrokenLinkListsAreRefusedWithTheirLine)
{
  const auto errorOf = [&](const std::string& text) {
    std::ofstream(*folder_ / "links.txt") << text;
    const auto outcome =
        run("broken", {"--graph-in", (*folder_ / "links.txt").string()});
    EXPECT_EQ(outcome.exit_code, 1) << text;
    return outcome.err;
  };
  EXPECT_NE(errorOf("0 1\nx 2\n").find("line 2"), std::string::npos);
  EXPECT_NE(errorOf("3 3\n").find("scan 3 is linked to itself"), std::string::npos);
  EXPECT_NE(errorOf("0 99\n").find("scan 99, which is not among"), std::string::npos);
}

TEST_F(Graph, WordsThatAreNoneAreRefused)
{
  for (const char* option : {"--loop-closing", "--relaxation", "--links"})
    EXPECT_EQ(run("no", {option, "foo"}).exit_code, 2) << option;
  EXPECT_EQ(run("no", {"--relaxation-rounds", "0"}).exit_code, 2);
}
