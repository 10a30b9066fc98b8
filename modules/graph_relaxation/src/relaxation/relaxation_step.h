// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "relaxation/link_equation.h"

#include <pcl6d/graph_relaxation/parameterisations.h>

#include <memory>
#include <utility>
#include <vector>

namespace pcl6d::graph_relaxation {

/** \brief A link in the linear system. */
struct RoundLink {
  std::size_t from = 0;
  std::size_t to = 0;
  LinkSums sums;                      ///< of pairs
  const PoseLink* measured = nullptr; ///< or a measured link
  LinkEquation<6> equation;
  double factor = 1; ///< weight of the equation, beside 1 / variance
};

/** \brief Index map from poses to unknowns. The first pose of each component is fixed. */
struct GraphLayout {
  static constexpr std::size_t kFixed = static_cast<std::size_t>(-1);

  std::vector<std::size_t> component; ///< per pose: first pose of its component
  std::vector<std::size_t> unknown;   ///< per pose: index of its unknown, or kFixed
  std::size_t num_unknowns = 0;
  /** (a, b) of unknowns, a < b, each once */
  std::vector<std::pair<std::size_t, std::size_t>> couplings;
  /** per link: its index in couplings, or kFixed */
  std::vector<std::size_t> coupling_of_link;

  GraphLayout() = default;
  GraphLayout(std::size_t num_poses, const std::vector<RoundLink>& links);
};

/** \brief The state of a round: the input of a step. */
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

/** \brief A parameterisation of GraphSLAM: solves one linear system and updates the poses. */
class RelaxationStep {
public:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  virtual ~RelaxationStep() = default;

  /** \param[in] damping share of the diagonal's mean, separate for translations and turns,
   * added to the diagonal
   * \return whether the system was solved; the poses of the round have then moved */
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
