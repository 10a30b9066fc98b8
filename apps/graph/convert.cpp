// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/option_table.h"
#include "graph/verbs.h"

#include <pcl6d/io/pose_graph_io.h>

#include <cstdio>

namespace pcl6d::app {

int
runConvert(const std::vector<std::string>& arguments)
{
  std::string input, output;
  PoseGraphFormat format = PoseGraphFormat::kAuto;
  OptionTable table(std::string("usage: ") + kGraph +
                    R"( convert IN -o OUT [options]
Writes a pose graph in another format, its poses as they are: g2o (VERTEX_SE3:QUAT,
EDGE_SE3:QUAT) or TORO (VERTEX3, EDGE3). IN is either of them, such as graph.g2o of a
run; without vertices, poses follow from the links. chi2 stays the same.
)");
  table.positional("IN", &input);
  table.group("Output");
  table.add("output,o FILE", &output).required().help("graph file");
  table.add("format", &format, poseGraphFormatFromName)
      .help("auto|g2o|toro; auto: TORO for OUT.graph and OUT.toro, else g2o");
  if (!table.parse(arguments))
    return kDone;
  refuseInputs(output, {input}, "the input");
  const PoseGraph graph = readPoseGraph(input);
  writePoseGraph(output, graph, format);
  std::printf("poses %zu edges %zu to %s\n",
              graph.poses.size(),
              graph.links.size(),
              toString(formatToWrite(output, format)).c_str());
  flushOutput();
  return kDone;
}

} // namespace pcl6d::app
