// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_graph as a user runs it.
#include "graph_relaxation/graph_cases.h"
#include "support/run_program.h"

#include <pcl6d/graph_relaxation/link_error.h>
#include <pcl6d/io/pose_graph_io.h>

#include <gtest/gtest.h>

#include <string>
#include <vector>

using pcl6d::PoseGraph;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {
constexpr const char* kName = "pcl_slam6d_graph";
constexpr double kNoise = 0.05; // [m], [rad]

Outcome
graphProgram(const std::vector<std::string>& arguments)
{
  return pcl6d::test::runProgram(kName, arguments);
}

void
expectError(const Outcome& outcome, int code, const std::vector<std::string>& words)
{
  pcl6d::test::expectError(outcome, kName, code, words);
}

/** A folder with a noisy ring of 30 poses, started from its chain. */
struct Files : TempFolder {
  Files()
  {
    graph = pcl6d::test::ringGraph(30, kNoise, 1);
    pcl6d::test::startFromChain(graph);
    pcl6d::writePoseGraphG2o(*this / "in.g2o", graph);
  }
  std::string
  name(const std::string& file) const
  {
    return *this / file;
  }
  PoseGraph graph;
};

/** \return the number behind the word, e.g. behind "iterations" */
double
numberBehind(const std::string& word, const std::string& text)
{
  const auto place = text.find(word);
  EXPECT_NE(place, std::string::npos) << word << " in " << text;
  return place == std::string::npos ? NAN : std::stod(text.substr(place + word.size()));
}
} // namespace

TEST(Graph, OptimizesAndTellsTheNumbers)
{
  const Files files;
  const auto outcome =
      graphProgram({"optimize", files.name("in.g2o"), "-o", files.name("out.g2o")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(outcome.out.rfind("poses 30 edges 38\nchi2 ", 0), 0u) << outcome.out;
  const double before = chi2Of(files.graph);
  EXPECT_NEAR(numberBehind("chi2 ", outcome.out), before, 1e-9 * before);
  const PoseGraph written = pcl6d::readPoseGraph(files / "out.g2o");
  EXPECT_LT(chi2Of(written), 0.1 * before);
  EXPECT_EQ(written.links.size(), files.graph.links.size());
  EXPECT_GE(numberBehind("iterations ", outcome.out), 2);
  EXPECT_GE(numberBehind("seconds ", outcome.out), 0);
}

TEST(Graph, GivesTheSameFileForAnyNumberOfThreadsAndBothMethodsTheSameOptimum)
{
  const Files files;
  const auto optimize = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "optimize", files.name("in.g2o"), "-o", files.name("out.g2o")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = graphProgram(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return readText(files / "out.g2o");
  };
  const std::string one = optimize({"--threads", "1"});
  EXPECT_EQ(one, optimize({"--threads", "3"}));
  const double chi2 = chi2Of(pcl6d::readPoseGraph(files / "out.g2o"));
  optimize({"--method", "levenberg-marquardt", "--iterations", "200"});
  EXPECT_NEAR(chi2Of(pcl6d::readPoseGraph(files / "out.g2o")), chi2, 1e-5 * chi2);
}

TEST(Graph, SwitchesWrongLinksOff)
{
  Files files;
  for (auto& link : files.graph.links)
    link.information = pcl6d::Matrix6::Identity() / (kNoise * kNoise);
  for (std::size_t k = 30; k < 32; ++k) // chords
    files.graph.links[k].T_from_to.translation() += Eigen::Vector3d(20, -10, 5);
  pcl6d::writePoseGraphG2o(files / "wrong.g2o", files.graph);
  const auto outcome = graphProgram({"optimize",
                                     files.name("wrong.g2o"),
                                     "-o",
                                     files.name("out.g2o"),
                                     "--robust",
                                     "graduated",
                                     "--trust-chain"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(numberBehind("edges of weight below 0.1: ", outcome.out), 2) << outcome.out;
  for (const char* const kernel : {"none", "huber", "cauchy", "geman-mcclure"})
    EXPECT_EQ(graphProgram({"optimize",
                            files.name("in.g2o"),
                            "-o",
                            files.name("out.g2o"),
                            "--robust",
                            kernel})
                  .exit_code,
              0)
        << kernel;
}

TEST(Graph, DoubtsWhatHasNotConverged)
{
  const Files files;
  const auto outcome = graphProgram({"optimize",
                                     files.name("in.g2o"),
                                     "-o",
                                     files.name("out.g2o"),
                                     "--iterations",
                                     "1"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("max-iterations"), std::string::npos) << outcome.err;
  EXPECT_EQ(pcl6d::readPoseGraph(files / "out.g2o").poses.size(), 30u);
}

TEST(Graph, TellsWhatAGraphHolds)
{
  const Files files;
  writeText(files / "graph",
            "VERTEX3 5 0 0 0 0 0 0\nVERTEX3 6 3 4 0 0 0 0\nVERTEX3 9 9 9 9 0 0 0\n"
            "EDGE3 5 6 3 4 1 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n");
  const auto outcome = graphProgram({"info", files.name("graph")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out,
            "poses 3 edges 1\ncomponents 2\ndegree min 0 mean 0.67 max 1\nchi2 1\n"
            "length 5.00 m\n");
}

TEST(Graph, WritesToroAndReadsItAgain)
{
  const Files files;
  const std::string in = files.name("in.g2o"), toro = files.name("a.graph");
  const std::string back = files.name("back.g2o"), again = files.name("again.txt");
  const auto outcome = graphProgram({"convert", in, "-o", toro});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "poses 30 edges 38 to toro\n");
  EXPECT_EQ(readText(toro).rfind("VERTEX3 0 ", 0), 0u);
  EXPECT_NE(readText(toro).find("\nEDGE3 "), std::string::npos);
  EXPECT_EQ(graphProgram({"convert", toro, "-o", back}).exit_code, 0);
  EXPECT_EQ(graphProgram({"convert", back, "-o", again, "--format", "toro"}).exit_code,
            0);
  const double chi2 = chi2Of(files.graph);
  for (const auto& file : {toro, back, again})
    EXPECT_NEAR(chi2Of(pcl6d::readPoseGraph(file)), chi2, 1e-9 * chi2) << file;
  EXPECT_EQ(graphProgram({"optimize", in, "-o", toro}).exit_code, 0);
  EXPECT_EQ(readText(toro).rfind("VERTEX3 0 ", 0), 0u);
  EXPECT_LT(chi2Of(pcl6d::readPoseGraph(toro)), 0.1 * chi2);
}

TEST(Graph, RefusesAWrongCommandLine)
{
  const Files files;
  const std::string in = files.name("in.g2o"), out = files.name("out.g2o");
  const std::string before = readText(in);
  expectError(graphProgram({"paint"}), 2, {"optimize, info"});
  expectError(graphProgram({"solve"}), 2, {"'solve'", "optimize, info"});
  expectError(graphProgram({"optimize", in}), 2, {"output"});
  expectError(graphProgram({"optimize", "-o", out}), 2, {"IN"});
  expectError(graphProgram({"optimize", in, "-o", in}), 2, {"is the input"});
  expectError(graphProgram({"optimize", in, "-o", out, "--method", "newton"}),
              2,
              {"--method = newton", "gauss-newton, levenberg-marquardt"});
  expectError(graphProgram({"optimize", in, "-o", out, "--robust", "l1"}),
              2,
              {"--robust = l1", "huber"});
  expectError(graphProgram({"optimize", in, "-o", out, "--iterations", "0"}),
              2,
              {"--iterations = 0"});
  expectError(graphProgram({"optimize", in, "-o", out, "--robust-width", "-1"}),
              2,
              {"--robust-width = -1"});
  expectError(graphProgram({"convert", in, "-o", out, "--format", "dot"}),
              2,
              {"--format = dot", "auto|g2o|toro"});
  expectError(graphProgram({"convert", in, "-o", in}), 2, {"is the input"});
  EXPECT_EQ(readText(in), before) << "inputs are never modified";
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Graph, NamesWhatIsWrongWithTheData)
{
  const Files files;
  const std::string out = files.name("out.g2o");
  writeText(files / "bad", "VERTEX3 0 0 0 0 0 0 0\nEDGE3 0 1 0 0 0 0 0\n");
  expectError(graphProgram({"optimize", files.name("none"), "-o", out}), 1, {"none"});
  expectError(graphProgram({"optimize", files.name("bad"), "-o", out}),
              1,
              {"bad", "line 2", "29 numbers"});
  expectError(graphProgram({"info", files.name("bad")}), 1, {"line 2"});
  expectError(
      graphProgram({"optimize", files.name("in.g2o"), "-o", files.name("bad/x")}),
      1,
      {"bad/x"});
}

TEST(Graph, Helps)
{
  EXPECT_EQ(graphProgram({"--help"}).exit_code, 0);
  EXPECT_EQ(graphProgram({"--version"}).exit_code, 0);
  const auto details = graphProgram({"optimize", "--help"});
  EXPECT_EQ(details.exit_code, 0);
  for (const char* const word :
       {"--method", "--robust", "--threads", "--iterations", "gauss-newton", "4.1"})
    EXPECT_NE(details.out.find(word), std::string::npos) << word;
}

TEST(Graph, FixedPosesKeepTheirPlaceAndStayFixed)
{
  const Files files;
  for (const std::string fixed : {"FIX 7\n", "FIX 7\nFIX 20\n"}) {
    writeText(files.name("fixed.g2o"), readText(files.name("in.g2o")) + fixed);
    const auto outcome = graphProgram(
        {"optimize", files.name("fixed.g2o"), "-o", files.name("out.g2o")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto out = pcl6d::readPoseGraphFile(files.name("out.g2o"));
    for (const std::size_t i : out.constraints.fixed)
      EXPECT_TRUE(out.graph.poses[i].isApprox(files.graph.poses[i], 1e-12));
    EXPECT_EQ(out.constraints.fixed.size(), fixed.size() > 7 ? 2U : 1U);
    EXPECT_FALSE(out.graph.poses[0].isApprox(files.graph.poses[0], 1e-6));
    EXPECT_LT(chi2Of(out.graph), chi2Of(files.graph));
  }
  // One fixed pose only chooses the frame.
  writeText(files.name("fixed.g2o"), readText(files.name("in.g2o")) + "FIX 7\n");
  graphProgram({"optimize", files.name("fixed.g2o"), "-o", files.name("a.g2o")});
  graphProgram({"optimize", files.name("in.g2o"), "-o", files.name("b.g2o")});
  EXPECT_NEAR(chi2Of(pcl6d::readPoseGraph(files.name("a.g2o"))),
              chi2Of(pcl6d::readPoseGraph(files.name("b.g2o"))),
              1e-6);
}

TEST(Graph, WhatItCannotUseIsAnErrorUnlessItIsSkipped)
{
  const Files files;
  writeText(files.name("more.g2o"),
            readText(files.name("in.g2o")) + "VERTEX_XY 99 1 2\n");
  expectError(graphProgram({"info", files.name("more.g2o")}),
              1,
              {"VERTEX_XY", "--skip-unknown leaves unknown lines out"});
  const auto outcome = graphProgram({"info", files.name("more.g2o"), "--skip-unknown"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "pcl_slam6d_graph: warning: skipped 1 line VERTEX_XY\n");
}

TEST(Graph, ConstraintsCountAndAreKept)
{
  const Files files;
  // The priors place the ring 100 m away; the switchable link is wrong.
  pcl6d::GraphConstraints constraints;
  for (const std::size_t i : {0U, 10U, 20U}) {
    pcl6d::PosePrior prior;
    prior.pose = i;
    prior.T_world_pose = Eigen::Translation3d(100, 0, 0) * files.graph.poses[i];
    prior.information.setIdentity();
    constraints.priors.push_back(prior);
  }
  PoseGraph graph = files.graph;
  graph.links.push_back(graph.links.front());
  graph.links.back().to = 15;
  constraints.switches = {{graph.links.size() - 1, 77, 1, 1, 10}};
  pcl6d::writePoseGraph(
      files.name("c.g2o"), graph, pcl6d::PoseGraphFormat::kG2o, constraints);
  const auto info = graphProgram({"info", files.name("c.g2o")});
  EXPECT_NE(info.out.find("priors 3\nswitches 1 off 0\n"), std::string::npos)
      << info.out;
  const auto outcome =
      graphProgram({"optimize", files.name("c.g2o"), "-o", files.name("out.g2o")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("switches 1 off 1\n"), std::string::npos) << outcome.out;
  const auto out = pcl6d::readPoseGraphFile(files.name("out.g2o"));
  EXPECT_EQ(out.constraints.priors.size(), 3U);
  ASSERT_EQ(out.constraints.switches.size(), 1U);
  EXPECT_LT(out.constraints.switches[0].value, 0.1);
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < graph.poses.size(); ++i)
    shift += out.graph.poses[i].translation() - graph.poses[i].translation();
  EXPECT_NEAR(shift.x() / static_cast<double>(graph.poses.size()), 100, 2);
  for (const std::string verb : {"optimize", "convert"})
    expectError(graphProgram({verb, files.name("c.g2o"), "-o", files.name("c.toro")}),
                1,
                {"TORO has no lines for landmarks, priors and switches"});
}
