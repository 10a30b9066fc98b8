// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/semantic_map/map_query.h>

#include <string>

/** \file Subjects of queries and their properties. Internal to the module
 * semantic_map. */
namespace pcl6d::semantic_map {

/** \return the subject in the plural: "objects" for "object" and "objects"; empty:
 * unknown */
std::string
pluralOf(const std::string& subject);

/** \return "objects, planes, ..." */
std::string
subjectNames();

/** \return the properties of every entity of a subject, in the order of the map
 * \param[in] subject in the plural */
std::vector<Properties>
propertiesOf(const SemanticMap& map, const std::string& subject);

/** \return the properties of a subject's entities, with placeholder values of the right
 * kind */
Properties
prototypeOf(const std::string& subject);

} // namespace pcl6d::semantic_map
