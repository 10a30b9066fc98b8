// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/pose_graph.h>

namespace pcl6d::graph_relaxation {

/** \brief The poses and links of a connected part of a graph, ascending. Internal to
 * the module graph_relaxation. */
struct GraphPart {
  std::vector<std::size_t> poses;
  std::vector<std::size_t> links; ///< without those that carry no information
};

/** \return the parts of a graph in the order of their first poses */
std::vector<GraphPart>
connectedParts(const PoseGraph& graph);

} // namespace pcl6d::graph_relaxation
