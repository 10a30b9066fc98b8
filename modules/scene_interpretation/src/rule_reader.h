// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/json_object.h>
#include <pcl6d/scene_interpretation/label_rules.h>

#include <string>

/** \file Reading of LabelRules. Internal to the module scene_interpretation. */
namespace pcl6d::scene_interpretation {

/** \brief Adds labels, constraints and needs of a file to rules. \throws IoFailed see
 * readLabelRules(), except contradictions */
void
addRules(const JsonValue& json, LabelRules& rules);

/** \brief Checks that rules can be satisfied: no label with contradictory conditions,
 * no constraint that its labels cannot fulfil, no cycle of labels above each other, no
 * need without a possible partner.
 * \throws IoFailed naming file, position and contradiction */
void
checkRules(const LabelRules& rules, const std::string& file);

} // namespace pcl6d::scene_interpretation
