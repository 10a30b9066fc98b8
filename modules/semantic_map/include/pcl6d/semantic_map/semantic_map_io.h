// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Writes a map as JSON (fields: share/doc/semantic_map.md), atomically. Numbers come
 * back to the last bit.
 * \throws BadArgument a number that is not finite, which JSON has not
 * \throws IoFailed the file cannot be written \ingroup semantic_map */
void
writeSemanticMap(const std::filesystem::path& path, const SemanticMap& map);

/** \brief Reads what writeSemanticMap() wrote; fields that it does not know are skipped.
 * \throws IoFailed naming file, place in it (as a JSON pointer, `/planes/3/normal`), value
 * and rule: no JSON, another schema_version, a field missing or of another kind, a pose
 * that is not rigid, ids that are not 1, 2, ..., or things that are not in the map */
SemanticMap
readSemanticMap(const std::filesystem::path& path);

/** \brief Who made a list of objects, and how long it took. */
struct MapObjectsOrigin {
  double seconds = 0;
  std::string generator; ///< name of the program
};

/** \brief Writes `objects.json`, atomically; what readMapObjects() reads.
 * \throws IoFailed the file cannot be written */
void
writeMapObjects(const std::filesystem::path& path,
                const std::vector<MapObject>& objects,
                const MapObjectsOrigin& origin = {});

/** \brief Reads a list of objects, `objects.json` of a run or `objects_truth.json` of a
 * simulation: `class` and `T_world_object` of each must be there; `extent` and `centre` of
 * its box, `score`, `visible_fraction`, `rms`, `covariance`, `symmetry`, `scans`, `moves`, `points` may be.
 * \throws IoFailed as readSemanticMap() */
std::vector<MapObject>
readMapObjects(const std::filesystem::path& path);

} // namespace pcl6d
