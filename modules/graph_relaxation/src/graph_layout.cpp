// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation_step.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace pcl6d {

namespace {
/** \return per pose the lowest pose that links join it to (union-find) */
std::vector<std::size_t>
componentsOf(std::size_t num_poses, const std::vector<RoundLink>& links)
{
  std::vector<std::size_t> parent(num_poses);
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i)
      i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const RoundLink& link : links) {
    const std::size_t a = root(link.from), b = root(link.to);
    parent[std::max(a, b)] = std::min(a, b);
  }
  for (std::size_t i = 0; i < num_poses; ++i)
    parent[i] = root(i);
  return parent;
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

} // namespace pcl6d
