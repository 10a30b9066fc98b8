// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "links/link_terms.h"
#include "relaxation/graph_components.h"
#include "relaxation/robust_cost.h"

#include <pcl6d/graph_relaxation/block_system.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>

namespace pcl6d::graph_relaxation {

/** \brief The least squares problem of a connected part of a graph: unknown i is pose
 * i + 1 of the part, as the first one is fixed. Internal to the module
 * graph_relaxation. */
class PoseGraphProblem {
public:
  using Poses = std::vector<QuaternionPose>;

  PoseGraphProblem(const PoseGraph& graph,
                   const GraphPart& part,
                   const PoseGraphOptions& options);

  std::size_t
  numPoses() const
  {
    return part_.poses.size();
  }
  const GraphPart&
  part() const
  {
    return part_;
  }

  /** \return e^T information e of each link */
  std::vector<double>
  squaredErrors(const Poses& poses) const;

  /** \return the sum of rho over the links */
  double
  cost(const std::vector<double>& squared_errors, const RobustCost& robust) const;

  /** \return the weight of each link */
  std::vector<double>
  weights(const std::vector<double>& squared_errors, const RobustCost& robust) const;

  /** \brief Sets up the normal equations. */
  void
  linearize(const Poses& poses, const std::vector<double>& weights);

  /** \brief Adds to the diagonal a share of its mean, where links leave a motion free.
   */
  void
  addRidge();

  /** \return the step, (dt, dr) of each unknown, or nothing if there is none
   * \param[in] damping see BlockSystem::factorize() */
  bool
  solve(double damping, std::vector<Vector6>& step);

  /** \return how much an undamped step lowers the cost, were it quadratic */
  double
  expectedDecrease(const std::vector<Vector6>& step) const;

  BlockSystem<6>&
  system()
  {
    return system_;
  }

private:
  struct End {
    std::size_t link;
    bool is_from;
  };
  struct LocalLink {
    std::size_t from;
    std::size_t to;
    bool trusted; ///< by every kernel
  };
  struct Coupling {
    std::size_t first_link; ///< in coupled_links_
    std::size_t last_link;
    std::size_t row; ///< pose
  };

  void
  findStructure();
  void
  sumDiagonal(std::size_t unknown);
  void
  sumCoupling(std::size_t coupling);

  GraphPart part_;
  unsigned int num_threads_;
  std::vector<LinkMeasurement> measurements_;
  std::vector<LocalLink> links_;
  std::vector<std::vector<End>> ends_at_; ///< the ends of links at each unknown
  std::vector<Coupling> couplings_;
  std::vector<std::size_t> coupled_links_;
  std::vector<LinkTerms> terms_;
  std::vector<Vector6> gradient_;
  BlockSystem<6> system_;
};

} // namespace pcl6d::graph_relaxation
