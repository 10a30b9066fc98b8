// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "graph/reading.h"
#include "graph/verbs.h"

#include <pcl6d/io/pose_graph_io.h>

#include <cstdio>

namespace pcl6d::app {

int
runConvert(const std::vector<std::string>& arguments)
{
  std::string input, output;
  PoseGraphFormat format = PoseGraphFormat::kAuto;
  PoseGraphReaderOptions reading;
  OptionTable table(std::string("usage: ") + kGraph +
                    R"( convert IN -o OUT [options]
Writes a pose graph in another format with unchanged poses: g2o (VERTEX_SE3:QUAT,
EDGE_SE3:QUAT) or TORO (VERTEX3, EDGE3). IN has either format, for example graph.g2o of
a run; without vertices, poses follow from the links. chi2 does not change.
)");
  table.positional("IN", &input);
  table.group("Output");
  table.add("output,o FILE", &output).required().help("graph file");
  table.add("format", &format, poseGraphFormatFromName)
      .help("auto|g2o|toro; auto: TORO for OUT.graph and OUT.toro, else g2o");
  table.group("Input");
  addReading(table, reading);
  if (!table.parse(arguments))
    return kDone;
  refuseInputs(output, {input}, "the input");
  const PoseGraphFile file = readPoseGraphFile(input, reading);
  const PoseGraph& graph = file.graph;
  refuseConstraintsOfToro(file, output, format);
  writePoseGraph(output, graph, format, file.constraints);
  warnOfSkipped(file);
  if (!file.constraints.fixed.empty() &&
      formatToWrite(output, format) == PoseGraphFormat::kToro)
    std::printf("dropped FIX of %zu poses: TORO has no FIX\n",
                file.constraints.fixed.size());
  std::printf("poses %zu edges %zu to %s\n",
              graph.poses.size(),
              graph.links.size(),
              toString(formatToWrite(output, format)).c_str());
  flushOutput();
  return kDone;
}

} // namespace pcl6d::app
