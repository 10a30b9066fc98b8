// SPDX-License-Identifier: BSD-3-Clause
// What a run tells of its links and of the stages that moved all scans.
#include "slam6d/run_writer.h"

#include <pcl6d/io/pose_graph_io.h>
#include <pcl6d/run/run_links_io.h>

namespace pcl6d::app {

void
RunWriter::writeGraph() const
{
  PoseGraph graph = result_.graph;
  graph.poses.clear();
  for (std::size_t i = 0; i < folder_.size(); ++i) {
    graph.poses.push_back(result_.scans[i].T_world_scan);
    graph.ids.push_back(folder_.index(i));
  }
  writePoseGraphG2o(out_ / "graph.g2o", graph);
  std::vector<RunLink> links;
  for (const ScanLink& link : result_.links)
    links.push_back({static_cast<std::size_t>(folder_.index(link.from)),
                     static_cast<std::size_t>(folder_.index(link.to)),
                     toString(link.kind),
                     toString(link.verdict),
                     link.reason,
                     link.distance,
                     link.pairs,
                     link.rms,
                     link.overlap,
                     link.condition,
                     link.weight});
  writeRunLinks(out_ / "links.csv", links);
}

void
RunWriter::describeGraph()
{
  for (const StageResult& stage : result_.stages)
    summary_.graph_stages.push_back({stage.name,
                                     stage.undone,
                                     stage.reason,
                                     stage.agreement_before,
                                     stage.agreement_after,
                                     stage.rounds,
                                     stage.seconds});
  for (const ScanLink& link : result_.links)
    ++(link.verdict == LinkVerdict::kUsed ? summary_.links_used
                                          : summary_.links_refused);
  for (const std::size_t i : result_.floating)
    summary_.floating.push_back(folder_.name(i));
}

} // namespace pcl6d::app
