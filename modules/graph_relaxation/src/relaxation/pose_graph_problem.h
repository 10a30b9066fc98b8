// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "links/link_terms.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/pose_graph.h>
#include <pcl6d/graph_relaxation/block_system.h>
#include <pcl6d/graph_relaxation/pose_graph_optimizer.h>
#include <pcl6d/registration/icp_options.h>

#include <cmath>

namespace pcl6d::graph_relaxation {

/** \brief The poses and links of a connected part of a graph, ascending. */
struct GraphPart {
  std::vector<std::size_t> poses;
  std::vector<std::size_t> links; ///< without links that carry no information
};

/** \return the parts of a graph in the order of their first poses */
std::vector<GraphPart>
connectedParts(const PoseGraph& graph);

/** \brief rho(s) of a link's squared error s, and its derivative, the link's weight. */
struct RobustCost {
  RobustKernel kernel = RobustKernel::kNone;
  double width_sq = 1; ///< of the s at which the kernel sets in

  double
  cost(double s) const
  {
    switch (kernel) {
    case RobustKernel::kHuber:
      return s <= width_sq ? s : 2 * std::sqrt(width_sq * s) - width_sq;
    case RobustKernel::kCauchy:
      return width_sq * portableLog(1 + s / width_sq);
    case RobustKernel::kGemanMcClure:
      return s * width_sq / (s + width_sq);
    case RobustKernel::kNone:
      break;
    }
    return s;
  }

  double
  weight(double s) const
  {
    const double share = width_sq / (s + width_sq);
    switch (kernel) {
    case RobustKernel::kHuber:
      return s <= width_sq ? 1 : std::sqrt(width_sq / s);
    case RobustKernel::kCauchy:
      return share;
    case RobustKernel::kGemanMcClure:
      return share * share;
    case RobustKernel::kNone:
      break;
    }
    return 1;
  }
};

/** \brief The least squares problem of a connected component: unknown i is pose i + 1 of the
 * part, as its first pose is fixed. */
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

  /** \brief Adds to the diagonal a share of its mean, where links leave a motion free. */
  void
  addRidge();

  /** \return whether a step exists
   * \param[in] damping see BlockSystem::factorize()
   * \param[out] step (dt, dr) of each unknown */
  bool
  solve(double damping, std::vector<Vector6>& step);

  /** \return the decrease of the cost by an undamped step, for a quadratic cost */
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
