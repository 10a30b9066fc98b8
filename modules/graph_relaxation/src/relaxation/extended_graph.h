// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/graph_constraints.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>

#include <vector>

namespace pcl6d::graph_relaxation {

/** \return the prior as a link from the world, pose 0 of an ExtendedGraph, to its pose with
 * index + 1 */
PoseLink
linkOf(const PosePrior& prior);

/** \brief A pose graph with constraints as links: the world, if priors exist, then the poses,
 * then the landmarks as poses. The links of the graph come first, in their order. */
class ExtendedGraph {
public:
  /** \param[in] poses in place of the graph's poses */
  ExtendedGraph(const PoseGraph& graph,
                const std::vector<Eigen::Isometry3d>& poses,
                const GraphConstraints& constraints);

  const PoseGraph&
  graph() const
  {
    return graph_;
  }

  /** \brief Extracts poses and landmarks from a result; fixed poses keep their values.
   * \param[in,out] poses on input, the poses of the constructor */
  void
  takeBack(const PoseGraphResult& result,
           std::vector<Eigen::Isometry3d>& poses,
           std::vector<Eigen::Vector3d>& landmarks) const;

private:
  void
  addIds(const PoseGraph& graph);
  void
  addPriors();
  void
  addFixed(const PoseGraph& graph);
  void
  addSightings();

  PoseGraph graph_;
  const GraphConstraints& constraints_;
  std::size_t first_ = 0;     ///< index of the first pose: 1 behind the world
  std::size_t num_poses_ = 0; ///< of the given graph
};

} // namespace pcl6d::graph_relaxation
