// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "graph/verbs.h"

#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>
#include <pcl6d/io/pose_graph_io.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

namespace pcl6d::app {

namespace {
namespace po = boost::program_options;

struct OptimizeSettings {
  std::string input;
  std::string output;
  std::string method;
  std::string robust;
  PoseGraphOptions options;
};

constexpr const char* kGraduated = "graduated"; ///< beside the kernels, for --robust

std::string
listed(const std::vector<std::string>& names)
{
  std::string all;
  for (const auto& name : names)
    all += (all.empty() ? "" : "|") + name;
  return all;
}

void
describe(OptimizeSettings& s, CommandLine& line)
{
  PoseGraphOptions& options = s.options;
  s.method = toString(options.method);
  s.robust = toString(options.robust);
  line.group("Output").add_options()(
      "output,o", po::value(&s.output)->value_name("FILE")->required(), "g2o file");
  line.group("Optimisation")
      .add_options() //
      ("method",
       valueOf(s.method)->value_name("NAME"),
       listed(graphMethodNames()).c_str()) //
      ("robust",
       valueOf(s.robust)->value_name("NAME"),
       (listed(robustKernelNames()) + "|" + kGraduated +
        "; graduated: geman-mcclure, first wide, then narrow, which switches wrong "
        "links off")
           .c_str()) //
      ("robust-width",
       valueOf(options.robust_width)->value_name("R"),
       "error of a link, in standard deviations, at which the kernel sets in") //
      ("trust-chain",
       po::bool_switch(&options.trust_chain),
       "links between neighbours (odometry) always count fully")                  //
      ("iterations", valueOf(options.max_iterations)->value_name("N"), "at most") //
      ("threads",
       valueOf(options.num_threads)->value_name("N"),
       "0: one per core; never changes the result");
}

bool
parse(const std::vector<std::string>& arguments, OptimizeSettings& s)
{
  CommandLine line(
      std::string("usage: ") + kGraph +
      " optimize IN -o OUT.g2o [options]\n"
      "Finds the poses that fit the links of a pose graph best and writes "
      "the graph with\nthem. IN: g2o (VERTEX_SE3:QUAT, EDGE_SE3:QUAT) or "
      "TORO (VERTEX3, EDGE3); without\nvertices the chain of links gives "
      "the first poses. The first pose of each component\nkeeps its place. "
      "chi2 is the sum of e^T information e over all links, before and\n"
      "after.\n");
  line.positional("IN", &s.input);
  describe(s, line);
  if (!line.parse(arguments))
    return false;
  checkOptions(
      [&] {
        s.options.method = graphMethodFromName(s.method);
        s.options.graduated = s.robust == kGraduated;
        if (!s.options.graduated)
          s.options.robust = robustKernelFromName(s.robust);
        s.options.validate();
      },
      {{"max_iterations", "iterations"}});
  std::error_code missing; // a missing file is no input
  if (std::filesystem::equivalent(s.output, s.input, missing))
    throw UsageError("--output = " + s.output + ", but that is the input");
  return true;
}

void
printResult(const PoseGraph& graph, const PoseGraphResult& result, double seconds)
{
  std::printf("poses %zu edges %zu\n", graph.poses.size(), graph.links.size());
  if (result.components.size() > 1)
    std::printf("components %zu\n", result.components.size());
  std::printf("chi2 %.10g %.10g\n", result.chi2_before, result.chi2_after);
  std::printf("iterations %d\nseconds %.3f\n", result.iterations, seconds);
  const auto off = std::count_if(result.weights.begin(),
                                 result.weights.end(),
                                 [](double weight) { return weight < 0.1; });
  if (off > 0)
    std::printf("edges of weight below 0.1: %td\n", off);
  flushOutput();
}
} // namespace

int
runOptimize(const std::vector<std::string>& arguments)
{
  using Clock = std::chrono::steady_clock;
  OptimizeSettings s;
  if (!parse(arguments, s))
    return kDone;
  PoseGraph graph = readPoseGraph(s.input);
  const auto start = Clock::now();
  PoseGraphOptimizer optimizer(graph, s.options);
  const PoseGraphResult& result = optimizer.optimize();
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  printResult(graph, result, seconds);
  graph.poses = result.poses;
  writePoseGraphG2o(s.output, graph);
  if (result.status == Status::kOk)
    return kDone;
  std::fprintf(stderr,
               "%s: the result is not to be trusted: %s\n",
               kGraph,
               toString(result.status));
  return kDoubtful;
}

} // namespace pcl6d::app
