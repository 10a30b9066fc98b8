// SPDX-License-Identifier: BSD-3-Clause
// What a run tells of its links and of the stages that moved all scans.
#include "slam6d/run_writer.h"

#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/pose_graph_io.h>

#include <algorithm>
#include <iomanip>
#include <ostream>

namespace pcl6d::app {

namespace {
/** In quotes, which a comma in a reason needs. */
std::string
quoted(const std::string& text)
{
  std::string quoted = "\"";
  for (const char c : text)
    quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}
} // namespace

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
  writeFileAtomically(out_ / "links.csv", [&](std::ostream& csv) {
    csv << "from,to,kind,verdict,reason,distance,pairs,rms,overlap,condition,weight\n"
        << std::setprecision(6);
    for (const ScanLink& link : result_.links)
      csv << folder_.index(link.from) << ',' << folder_.index(link.to) << ','
          << toString(link.kind) << ',' << toString(link.verdict) << ','
          << quoted(link.reason) << ',' << link.distance << ',' << link.pairs << ','
          << link.rms << ',' << link.overlap << ',' << link.condition << ','
          << link.weight << '\n';
  });
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
