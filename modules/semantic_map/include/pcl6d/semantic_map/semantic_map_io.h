// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Writes a map as JSON (fields: share/doc/semantic_map.md), atomically. Numbers
 * keep every bit.
 * \throws BadArgument a number is not finite, as JSON cannot store it
 * \throws IoFailed the file cannot be written \ingroup semantic_map */
void
writeSemanticMap(const std::filesystem::path& path, const SemanticMap& map);

/** \brief Reads a file of writeSemanticMap(); unknown fields are skipped.
 * \throws IoFailed naming file, position (a JSON pointer, `/planes/3/normal`), value
 * and rule: not JSON, another schema_version, a field missing or of another kind, a
 * pose that is not rigid, ids that are not 1, 2, ..., or references to entities outside
 * the map */
SemanticMap
readSemanticMap(const std::filesystem::path& path);

/** \brief Origin of a list of objects, and duration of the search. */
struct MapObjectsOrigin {
  double seconds = 0;
  std::string generator; ///< name of the program
};

/** \brief Writes `objects.json`, atomically, to be read by readMapObjects().
 * \throws IoFailed the file cannot be written */
void
writeMapObjects(const std::filesystem::path& path,
                const std::vector<MapObject>& objects,
                const MapObjectsOrigin& origin = {});

/** \brief Reads a list of objects, `objects.json` of a run or `objects_truth.json` of a
 * simulation: `class` and `T_world_object` are required; `extent` and `centre` of the
 * box, `score`, `visible_fraction`, `rms`, `covariance`, `symmetry`, `scans`, `moves`,
 * `points` are optional.
 * \throws IoFailed see readSemanticMap() */
std::vector<MapObject>
readMapObjects(const std::filesystem::path& path);

} // namespace pcl6d
