// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "relaxation/link_switch.h"
#include "relaxation/relaxation_step.h"

#include <pcl6d/graph_relaxation/graph_slam.h>

#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace pcl6d::graph_relaxation {

/** \brief One run of GraphSLAM: statistics, rounds, stop rules, covariances, common to the
 * parameterisations. */
class GraphSlamRun {
public:
  /** \brief The pairs at some poses, kept by the caller for one round. */
  using Pairs = std::function<const std::vector<LinkPairs>&(const GraphSlam::Poses&)>;

  GraphSlamRun(const GraphSlamOptions& options,
               const std::vector<PoseLink>& measured,
               const GraphSlam::Observer& observer);

  /** \param[in] last_pairs_at pairs of a last round; null: no such round */
  GraphSlamResult
  run(const GraphSlam::Poses& start, const Pairs& pairs_at, const Pairs& last_pairs_at);

private:
  static constexpr double kLeastDamping = 1e-12; ///< where links leave directions open

  /** One round. \return whether further rounds may follow */
  bool
  goRound(const std::vector<LinkPairs>& pairs, int iteration);
  /** Sums up the pairs at the poses of the round and sets up its links. */
  void
  measure(const std::vector<LinkPairs>& pairs);
  void
  weigh();
  /** Reduces the weight of links that contradict the rest. */
  void
  switchLinks();
  /** Sets by how much each link counts in the round. */
  void
  setFactors();
  /** \return the constraint strength of a link's pairs in the round */
  double
  strengthOf(const RoundLink& link) const;
  /** Sums up the residuals of the pairs. */
  void
  sumUpError();
  /** One solution.
   * \return whether the poses have converged */
  bool
  advance(int iteration);
  bool
  hasDiverged();
  bool
  atRest(const GraphSlam::Poses& before, int iteration);
  Status
  finish();
  void
  fillCovariances();
  double
  commonVariance() const;

  const GraphSlamOptions& options_;
  const std::vector<PoseLink>& measured_;
  const GraphSlam::Observer& observer_;
  std::unique_ptr<RelaxationStep> step_;
  LinkSwitch switch_;
  bool switch_moves_ = true; ///< false: the weights of the last round stay
  std::vector<bool> trusted_;
  Round round_;
  GraphSlamResult result_;
  std::vector<std::size_t> report_of_link_; ///< of each link of the round with pairs
  bool links_alike_ = false;                ///< strong and weak links have equal weight
  double error_ = 0;                        ///< [m^2] mean square of this round
  double last_error_ = 0;                   ///< of the round before
  double link_error_ = 0;                   ///< [m^2] mean square, equal weights
  double best_error_ = std::numeric_limits<double>::infinity();
  double damping_ = 0; ///< 0: no open direction
  bool stopped_ = false, failed_ = false;
};

} // namespace pcl6d::graph_relaxation
