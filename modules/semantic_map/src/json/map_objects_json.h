// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/json_object.h>
#include <pcl6d/semantic_map/semantic_map.h>

/** \file JSON form of objects, common to maps and lists of objects. Internal to the
 * module semantic_map. */
namespace pcl6d::semantic_map {

using Json = nlohmann::ordered_json;

Json
toJson(const MapObject& object, std::size_t id);

MapObject
objectFrom(const JsonValue& place);

/** \return six rows of six numbers, or null */
Json
matrixOrNull(const std::optional<Eigen::Matrix<double, 6, 6>>& matrix);

/** \return the member with a name as a matrix, if present */
std::optional<Eigen::Matrix<double, 6, 6>>
matrix6From(const JsonValue& place, const std::string& key);

} // namespace pcl6d::semantic_map
