// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>

namespace pcl6d::test {

inline PoseGraphResult
optimized(const PoseGraph& graph, const PoseGraphOptions& options = {})
{
  return PoseGraphOptimizer(graph, options).optimize();
}

} // namespace pcl6d::test
