// SPDX-License-Identifier: BSD-3-Clause
#include "schema_keys.h"

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

} // namespace pcl6d::run_files
