// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/json_object.h>
#include <pcl6d/scene_interpretation/label_rules.h>

#include <string>

/** \file Reading of LabelRules. Internal to the module scene_interpretation. */
namespace pcl6d::scene_interpretation {

/** \brief Adds labels, constraints and needs of a file to rules.
 * \throws IoFailed as readLabelRules(), contradictions left out */
void
addRules(const JsonValue& json, LabelRules& rules);

/** \brief Makes sure that rules can be kept at all: no label whose conditions exclude
 * each other, no constraint that no two planes with its labels can fulfil, no labels
 * above each other in a circle, no need without a possible partner.
 * \throws IoFailed naming file, place and what contradicts what */
void
checkRules(const LabelRules& rules, const std::string& file);

} // namespace pcl6d::scene_interpretation
