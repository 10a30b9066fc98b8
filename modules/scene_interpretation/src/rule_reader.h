// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scene_interpretation/label_rules.h>

#include <nlohmann/json.hpp>

#include <string>

/** \file Reading of LabelRules. Internal to the module scene_interpretation. */
namespace pcl6d::scene_interpretation {

/** \brief A place in a file of rules, for messages. */
struct RulePlace {
  std::string file;
  std::string pointer; ///< of JSON; empty: the whole

  RulePlace
  operator/(const std::string& key) const
  {
    return {file, pointer + '/' + key};
  }

  RulePlace
  operator/(std::size_t index) const
  {
    return *this / std::to_string(index);
  }

  /** \throws IoFailed "file: pointer: message" */
  [[noreturn]] void
  fail(const std::string& message) const;
};

/** \brief Adds labels, constraints and needs of a file to rules.
 * \throws IoFailed as readLabelRules(), contradictions left out */
void
addRules(const nlohmann::ordered_json& json, const RulePlace& place, LabelRules& rules);

/** \brief Makes sure that rules can be kept at all: no label whose conditions exclude
 * each other, no constraint that no two planes with its labels can fulfil, no labels
 * above each other in a circle, no need without a possible partner.
 * \throws IoFailed naming file, place and what contradicts what */
void
checkRules(const LabelRules& rules, const std::string& file);

} // namespace pcl6d::scene_interpretation
