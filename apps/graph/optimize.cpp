// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "graph/reading.h"
#include "graph/verbs.h"

#include <pcl6d/graph_relaxation/constrained_graph.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/pose_graph_io.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace pcl6d::app {

namespace {
struct OptimizeSettings {
  std::string input;
  std::string output;
  PoseGraphFormat format = PoseGraphFormat::kAuto;
  PoseGraphOptions options;
  PoseGraphReaderOptions reading;
};

constexpr const char* kGraduated = "graduated"; ///< beside the kernels, for --robust

void
addOptions(OptionTable& table, OptimizeSettings& s)
{
  PoseGraphOptions& options = s.options;
  table.positional("IN", &s.input);
  table.group("Output");
  table.add("output,o FILE", &s.output).required().help("graph file");
  table.add("format", &s.format, poseGraphFormatFromName)
      .help("auto|g2o|toro; auto: TORO for OUT.graph and OUT.toro, else g2o");
  table.group("Input");
  addReading(table, s.reading);
  table.group("Optimisation");
  table.add("method NAME", &options.method, graphMethodFromName)
      .help(joined(graphMethodNames()));
  const auto takeRobust = [&options](const std::string& name) {
    options.graduated = name == kGraduated;
    if (!options.graduated)
      options.robust = robustKernelFromName(name);
  };
  table.addWord("robust NAME", toString(options.robust), takeRobust)
      .help(joined(robustKernelNames()) + "|" + kGraduated +
            "; graduated: geman-mcclure, first wide, then narrow, to switch wrong "
            "links off");
  table.add("robust-width R", &options.robust_width)
      .help("error of a link, in standard deviations, where the kernel sets in");
  table.add("trust-chain", &options.trust_chain)
      .help("links between neighbours (odometry) always count fully");
  table.add("iterations N", &options.max_iterations).help("at most");
  table.add("threads N", &options.num_threads)
      .help("0: a thread per core; never changes the result");
}

bool
parse(const std::vector<std::string>& arguments, OptimizeSettings& s)
{
  OptionTable table(std::string("usage: ") + kGraph +
                    R"( optimize IN -o OUT [options]
Finds the poses that fit the links of a pose graph best and writes the graph with
them. IN: g2o (VERTEX_SE3:QUAT, EDGE_SE3:QUAT) or TORO (VERTEX3, EDGE3); without
vertices the chain of links gives the first poses. Poses that FIX names keep their
place, else the first pose of each component without priors. Landmarks, priors and
switchable edges of g2o count and are kept; a switchable edge counts s^2 times, with the
switch s that fits best. chi2 is the sum of e^T information e, before and after.
)");
  addOptions(table, s);
  if (!table.parse(arguments))
    return false;
  table.check([&] { s.options.validate(); }, {{"max_iterations", "iterations"}});
  refuseInputs(s.output, {s.input}, "the input");
  return true;
}

void
printResult(const PoseGraph& graph,
            const ConstrainedGraphResult& result,
            double seconds)
{
  std::printf("poses %zu edges %zu\n", graph.poses.size(), graph.links.size());
  if (result.components > 1)
    std::printf("components %zu\n", result.components);
  std::printf("chi2 %.10g %.10g\n", result.chi2_before, result.chi2_after);
  std::printf("iterations %d\nseconds %.3f\n", result.iterations, seconds);
  const auto off = std::count_if(result.weights.begin(),
                                 result.weights.end(),
                                 [](double weight) { return weight < 0.1; });
  if (off > 0)
    std::printf("edges of weight below 0.1: %td\n", off);
  printConstraints(result.constraints);
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
  PoseGraphFile file = readPoseGraphFile(s.input, s.reading);
  warnOfSkipped(file);
  requireWritable(s.output);
  refuseConstraintsOfToro(file, s.output, s.format);
  const auto start = Clock::now();
  const ConstrainedGraphResult result =
      optimizeConstrained(file.graph, file.constraints, s.options);
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  printResult(file.graph, result, seconds);
  file.graph.poses = result.poses;
  writePoseGraph(s.output, file.graph, s.format, result.constraints);
  if (result.status == Status::kOk)
    return kDone;
  std::fprintf(stderr,
               "%s: the result is not to be trusted: %s\n",
               kGraph,
               toString(result.status));
  return kDoubtful;
}

} // namespace pcl6d::app
