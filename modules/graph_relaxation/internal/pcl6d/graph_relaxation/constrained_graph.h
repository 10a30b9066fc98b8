// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/graph_constraints.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Result of optimizeConstrained(). */
struct ConstrainedGraphResult {
  Status status = Status::kOk; ///< as PoseGraphResult::status
  std::vector<Eigen::Isometry3d> poses;
  GraphConstraints constraints; ///< the input with optimised landmarks and switches
  double chi2_before = 0;       ///< see chi2Of()
  double chi2_after = 0;
  int iterations = 0;          ///< of all rounds
  std::size_t components = 0;  ///< of poses, landmarks, and the world if priors exist
  std::vector<double> weights; ///< of each link: by the robust kernel, times s^2
};

/** \return the sum of e^T information e over links (times s^2 for links with a switch s),
 * priors and sightings, and of information (prior - s)^2 over switches
 * \throws BadArgument as optimizeConstrained()
 * \ingroup graph_relaxation */
double
chi2Of(const PoseGraph& graph, const GraphConstraints& constraints);

/** \brief Optimises poses, landmarks and switches of a graph with constraints, by
 * PoseGraphOptimizer.
 *
 * A prior is a link from the world, a fixed pose, and so fixes its component; a robust kernel
 * treats a prior as a link. A landmark is a pose with the rotation of the first pose that observes
 * the landmark, at no cost and without effect on the rest. Fixed poses are joined by links ten
 * thousand times as strong as the strongest link, and keep their positions to the last bit.
 *
 * Switches and poses are optimised in turn. At given poses the best switch is information prior
 * / (information + e^T information_link e): a link then counts as with the kernel of Geman and
 * McClure, with an individual width. Rounds end when the relative decrease of chi2 is at most
 * options.chi2_epsilon.
 * \throws BadArgument an invalid graph (see checkPoseGraph()), constraint (an index out of
 * range, not finite, invalid information, two switches of a link, a landmark without a
 * sighting) or option
 * \ingroup graph_relaxation */
ConstrainedGraphResult
optimizeConstrained(const PoseGraph& graph,
                    const GraphConstraints& constraints,
                    const PoseGraphOptions& options = {});

} // namespace pcl6d
