// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "relaxation/link_equation.h"

#include <pcl6d/graph_relaxation/parameterisations.h>

#include <memory>
#include <utility>
#include <vector>

namespace pcl6d::graph_relaxation {

/** \brief A link as it enters the linear system. */
struct RoundLink {
  std::size_t from = 0;
  std::size_t to = 0;
  LinkSums sums;                      ///< of pairs
  const PoseLink* measured = nullptr; ///< or this
  LinkEquation<6> equation;
  double factor = 1; ///< by which the equation counts, beside 1 / variance
};

/** \brief Which pose is which unknown. The first pose of each group of linked poses is
 * fixed. */
struct GraphLayout {
  static constexpr std::size_t kFixed = static_cast<std::size_t>(-1);

  std::vector<std::size_t> component; ///< per pose: first pose of its group
  std::vector<std::size_t>
      unknown; ///< per pose: its place among the unknowns, or kFixed
  std::size_t num_unknowns = 0;
  /** (a, b) of unknowns, a < b, each once */
  std::vector<std::pair<std::size_t, std::size_t>> couplings;
  /** per link: its place in couplings, or kFixed */
  std::vector<std::size_t> coupling_of_link;

  GraphLayout() = default;
  GraphLayout(std::size_t num_poses, const std::vector<RoundLink>& links);
};

/** \brief All that a step is computed from. */
struct Round {
  std::vector<Eigen::Isometry3d> poses;
  std::vector<RoundLink> links;
  GraphLayout layout;
  bool by_variance = false;  ///< equations count by 1 / variance
  double least_variance = 0; ///< [m^2] guard of s^2
  unsigned int num_threads = 0;

  /** \return by how much an equation of a link counts */
  double
  factorOf(const RoundLink& link, double variance) const
  {
    return by_variance ? link.factor / variance : link.factor;
  }
};

/** \brief What a parameterisation adds to GraphSLAM: one linear solution, and what it makes
 * of the poses. */
class RelaxationStep {
public:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  virtual ~RelaxationStep() = default;

  /** \param[in] damping share of the diagonal's mean, separate for translations and
   * turns, that is added to the diagonal \return whether the system could be
   * solved; if so, the poses of the round have moved */
  virtual bool
  advance(Round& round, double damping) = 0;

  /** \return per unknown the block of the inverse, in the order of a twist; empty: the
   * system cannot be solved */
  virtual std::vector<Matrix6>
  inverses(const Round& round, double damping) = 0;
};

std::unique_ptr<RelaxationStep>
makeRelaxationStep(Relaxation relaxation);

/** \brief The decoupled small angles (5.3.3). */
std::unique_ptr<RelaxationStep>
makeSmallAngleStep();

} // namespace pcl6d::graph_relaxation
