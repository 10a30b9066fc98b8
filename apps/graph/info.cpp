// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "graph/reading.h"
#include "graph/verbs.h"

#include <pcl6d/graph_relaxation/constrained_graph.h>
#include <pcl6d/io/pose_graph_io.h>

#include <algorithm>
#include <cstdio>

namespace pcl6d::app {

namespace {
/** \return how many links meet at each pose */
std::vector<std::size_t>
degreesOf(const PoseGraph& graph)
{
  std::vector<std::size_t> degrees(graph.poses.size(), 0);
  for (const auto& link : graph.links) {
    ++degrees[link.from];
    ++degrees[link.to];
  }
  return degrees;
}

/** \return the path length through the poses, summed over the components [m] */
double
lengthOf(const PoseGraph& graph, const PoseGraphResult& parts)
{
  double length = 0;
  for (std::size_t i = 0; i + 1 < graph.poses.size(); ++i)
    if (parts.component[i] == parts.component[i + 1])
      length +=
          (graph.poses[i + 1].translation() - graph.poses[i].translation()).norm();
  return length;
}
} // namespace

int
runInfo(const std::vector<std::string>& arguments)
{
  std::string input;
  PoseGraphReaderOptions reading;
  OptionTable table(std::string("usage: ") + kGraph +
                    R"( info IN
Tells what a pose graph (g2o or TORO) holds: poses, edges, connected components,
edges per pose, constraints, chi2 (the sum of e^T information e) and the length of the way from
each pose to the next.
)");
  table.positional("IN", &input);
  table.group("Input");
  addReading(table, reading);
  if (!table.parse(arguments))
    return kDone;
  const PoseGraphFile file = readPoseGraphFile(input, reading);
  const PoseGraph& graph = file.graph;
  warnOfSkipped(file);
  const PoseGraphOptimizer parts(graph); // not optimised
  const std::vector<std::size_t> degrees = degreesOf(graph);
  const auto [least, most] = std::minmax_element(degrees.begin(), degrees.end());
  std::printf("poses %zu edges %zu\n", graph.poses.size(), graph.links.size());
  if (!file.constraints.fixed.empty())
    std::printf("fixed %zu\n", file.constraints.fixed.size());
  printConstraints(file.constraints);
  std::printf("components %zu\n", parts.result().components.size());
  std::printf("degree min %zu mean %.2f max %zu\n",
              *least,
              2.0 * static_cast<double>(graph.links.size()) /
                  static_cast<double>(graph.poses.size()),
              *most);
  std::printf("chi2 %.10g\n", chi2Of(graph, file.constraints));
  std::printf("length %.2f m\n", lengthOf(graph, parts.result()));
  flushOutput();
  return kDone;
}

} // namespace pcl6d::app
