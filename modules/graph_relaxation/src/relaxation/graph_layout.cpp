// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/relaxation_step.h"

#include <pcl6d/common/components.h>

#include <algorithm>
#include <map>

namespace pcl6d::graph_relaxation {

namespace {
/** \return per pose the lowest pose that links join it to */
std::vector<std::size_t>
componentsOf(std::size_t num_poses, const std::vector<RoundLink>& links)
{
  Components components(num_poses);
  for (const RoundLink& link : links)
    components.join(link.from, link.to);
  return components.firsts();
}
} // namespace

GraphLayout::GraphLayout(std::size_t num_poses, const std::vector<RoundLink>& links)
: component(componentsOf(num_poses, links)), unknown(num_poses, kFixed)
{
  for (std::size_t i = 0; i < num_poses; ++i)
    if (component[i] != i)
      unknown[i] = num_unknowns++;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> places;
  for (const RoundLink& link : links) {
    const auto ends = std::minmax(unknown[link.from], unknown[link.to]);
    if (ends.second == kFixed) { // the larger one, as kFixed is the largest number
      coupling_of_link.push_back(kFixed);
      continue;
    }
    const auto [entry, is_new] = places.try_emplace(ends, couplings.size());
    if (is_new)
      couplings.push_back(ends);
    coupling_of_link.push_back(entry->second);
  }
}

} // namespace pcl6d::graph_relaxation
