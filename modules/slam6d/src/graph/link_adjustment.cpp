// SPDX-License-Identifier: BSD-3-Clause
#include "graph/graph_links.h"
#include "graph/link_adjustment.h"
#include "graph/measured_map.h"

#include <cstddef>

namespace pcl6d::slam6d {

std::vector<Eigen::Isometry3d>
adjustedToLinks(const std::vector<Eigen::Isometry3d>& T_world_scan,
                const MapVerification& map,
                double voxel,
                unsigned int num_threads)
{
  MeasuredMap measured = measuredMapOf(T_world_scan, map);
  if (!measured.are_refined || measured.scans.size() < 2)
    return {};
  PoseGraph& graph = measured.graph;
  for (std::size_t k = 0; k < graph.links.size(); ++k)
    if (!measured.links[k]->refined) {
      PoseLink& link = graph.links[k];
      link.T_from_to = graph.poses[link.from].inverse() * graph.poses[link.to];
    }
  PoseGraphOptions options;
  options.num_threads = num_threads;
  discountContradictions(options, measured);
  for (std::size_t v = 1; v < graph.poses.size(); ++v)
    graph.links.push_back(
        stepLink(v - 1, v, graph.poses[v - 1].inverse() * graph.poses[v], voxel));
  PoseGraphOptimizer optimizer(graph, options);
  const PoseGraphResult& best = optimizer.optimize();
  if (best.status == Status::kDiverged)
    return {};
  std::vector<Eigen::Isometry3d> poses = T_world_scan;
  for (std::size_t v = 0; v < measured.scans.size(); ++v)
    poses[measured.scans[v]] = best.poses[v];
  return poses;
}

} // namespace pcl6d::slam6d
