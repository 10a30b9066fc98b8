// SPDX-License-Identifier: BSD-3-Clause
#include "relaxation/graph_components.h"

#include <pcl6d/common/components.h>

namespace pcl6d::graph_relaxation {

namespace {
bool
isInformative(const PoseLink& link)
{
  return (link.information.array() != 0).any();
}
} // namespace

std::vector<GraphPart>
connectedParts(const PoseGraph& graph)
{
  Components components(graph.poses.size());
  for (const auto& link : graph.links)
    if (isInformative(link))
      components.join(link.from, link.to);
  std::vector<GraphPart> parts;
  std::vector<std::size_t> part_of(graph.poses.size());
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    const std::size_t first = components.firstOf(i);
    if (first == i) {
      part_of[i] = parts.size();
      parts.emplace_back();
    }
    part_of[i] = part_of[first];
    parts[part_of[i]].poses.push_back(i);
  }
  for (std::size_t k = 0; k < graph.links.size(); ++k)
    if (isInformative(graph.links[k]))
      parts[part_of[graph.links[k].from]].links.push_back(k);
  return parts;
}

} // namespace pcl6d::graph_relaxation
