// SPDX-License-Identifier: BSD-3-Clause
#include "schema_keys.h"

#include <pcl6d/common/run_result.h>

#include <map>

namespace pcl6d::run_files {

std::string
nameInFirstSchema(const std::string& name)
{
  static const std::map<std::string, std::string> kNames = {
      // summary.json
      {"deskewed", "undone"},
      {"disconnected", "floating"},
      {"dynamic", "moving"},
      {"inconclusive", "blind"},
      {"input_offset", "moved_points"},
      {"links_rejected", "links_refused"},
      {"path_length", "way"},
      {"reliable", "trusted"},
      {"reverted", "undone"},
      // verification of a map
      {"connected", "tied"},
      {"detectable", "noticed"},
      {"largest_shift", "most"},
      {"least_shift", "least"},
      {"rays_unreliable", "abstains"},
      {"verdict", "trust"},
      {"weakest_direction", "weakest"},
      // columns of verification.csv
      {"detectable_largest", "noticed_most"},
      {"detectable_least", "noticed_least"},
      {"detectable_turn", "noticed_turn"},
      {"result", "trust"},
      {"violated", "contradicted"}};
  const auto former = kNames.find(name);
  return former == kNames.end() ? name : former->second;
}

SchemaKeys
keysOf(const JsonValue& schema_version)
{
  const int version = schema_version.integer();
  schema_version.require(version >= kFirstSchema &&
                             version <= RunResult::kSchemaVersion,
                         std::to_string(kFirstSchema) + " to " +
                             std::to_string(RunResult::kSchemaVersion));
  return SchemaKeys(version);
}

} // namespace pcl6d::run_files
