// SPDX-License-Identifier: BSD-3-Clause
#include "graph_components.h"

#include <algorithm>
#include <numeric>

namespace pcl6d {

namespace {
bool
isInformative(const PoseLink& link)
{
  return (link.information.array() != 0).any();
}

/** \return the root of a tree of the forest; the way to it is shortened */
std::size_t
rootOf(std::vector<std::size_t>& forest, std::size_t i)
{
  while (forest[i] != i)
    i = forest[i] = forest[forest[i]];
  return i;
}
} // namespace

std::vector<GraphPart>
connectedParts(const PoseGraph& graph)
{
  std::vector<std::size_t> forest(graph.poses.size());
  std::iota(forest.begin(), forest.end(), 0);
  for (const auto& link : graph.links) {
    if (!isInformative(link))
      continue;
    const std::size_t a = rootOf(forest, link.from), b = rootOf(forest, link.to);
    forest[std::max(a, b)] = std::min(a, b); // so a root is the first pose of its tree
  }
  std::vector<GraphPart> parts;
  std::vector<std::size_t> part_of(graph.poses.size());
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    const std::size_t root = rootOf(forest, i);
    if (root == i) {
      part_of[i] = parts.size();
      parts.emplace_back();
    }
    part_of[i] = part_of[root];
    parts[part_of[i]].poses.push_back(i);
  }
  for (std::size_t k = 0; k < graph.links.size(); ++k)
    if (isInformative(graph.links[k]))
      parts[part_of[graph.links[k].from]].links.push_back(k);
  return parts;
}

} // namespace pcl6d
