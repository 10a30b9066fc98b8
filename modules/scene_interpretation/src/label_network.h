// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "constraint_network.h"

#include <pcl6d/scene_interpretation/interpretation.h>
#include <pcl6d/scene_interpretation/scene_plane.h>

#include <optional>
#include <string>
#include <vector>

/** \file Application of a set of rules to the planes of a scene. Internal to the module
 * scene_interpretation. */
namespace pcl6d::scene_interpretation {

/** \brief The labelling problem of planes, rules and storeys. */
class LabelProblem {
public:
  LabelProblem(const std::vector<ScenePlane>& planes,
               const std::vector<std::size_t>& storey_of,
               const LabelRules& rules,
               const RelationTolerances& tolerances)
  : planes_(planes), storey_of_(storey_of), rules_(rules), tolerances_(tolerances)
  {}

  const LabelRules&
  rules() const
  {
    return rules_;
  }

  std::size_t
  size() const
  {
    return planes_.size();
  }

  /** \return why the plane by itself cannot carry the label; nullopt if it can */
  std::optional<std::string>
  misfit(std::size_t plane, std::size_t label) const;

  /** \return the constraint that forbids label a for i beside label b for j */
  const PairRule*
  forbids(std::size_t i, std::size_t a, std::size_t j, std::size_t b) const;

  /** \return whether j with its label is the partner that i needs */
  bool
  meets(const NeedRule& need, std::size_t i, std::size_t j) const;

  /** \brief Builds the network of every label that fits. */
  ConstraintNetwork
  network(unsigned int num_threads) const;

private:
  const std::vector<ScenePlane>& planes_;
  const std::vector<std::size_t>& storey_of_;
  const LabelRules& rules_;
  const RelationTolerances& tolerances_;
};

/** \brief Explains a labelling. \param[in] labels per plane the index of its label in
 * the rules; labels.size() for no label */
std::vector<LabelExplanation>
explain(const LabelProblem& problem, const std::vector<std::size_t>& labels);

} // namespace pcl6d::scene_interpretation
