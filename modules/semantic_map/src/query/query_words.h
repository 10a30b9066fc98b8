// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/semantic_map/map_query.h>

#include <string>

/** \file Subjects of queries and what they stand for. Internal to the module
 * semantic_map. */
namespace pcl6d::semantic_map {

/** \return the subject in the plural: of "object" and "objects" the latter; empty: none */
std::string
pluralOf(const std::string& subject);

/** \return "objects, planes, ..." */
std::string
subjectNames();

/** \return the properties of all things of a subject, in the order of the map
 * \param[in] subject in the plural */
std::vector<Properties>
propertiesOf(const SemanticMap& map, const std::string& subject);

/** \return the properties that the things of a subject have, with values of the right kind
 * but no meaning */
Properties
prototypeOf(const std::string& subject);

} // namespace pcl6d::semantic_map
