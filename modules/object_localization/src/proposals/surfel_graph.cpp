// SPDX-License-Identifier: BSD-3-Clause
#include "proposals/surfel_graph.h"

#include <pcl6d/common/components.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/voxel_key.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

namespace pcl6d::object_localization {

namespace {
constexpr std::size_t kEdgeBlock = 256; // surfels
constexpr std::size_t kMostLinks = 64;  // of a surfel; itself included
constexpr float kReach = 4;             // [spacings] of links

Points
placesOf(const Surfels& surfels, const std::vector<std::uint32_t>& chosen)
{
  Points points;
  for (const auto i : chosen)
    points.push_back(surfels.points[i]);
  return points;
}

/** \return the distance [m] of surfels where they are dense, from the area of the
 * surfels that define a normal */
float
leastSpacing(const Surfels& all, const std::vector<std::uint32_t>& surfels)
{
  constexpr std::size_t kDense = 4; // the densest quarter of the surfels
  std::vector<float> radii;
  for (const auto i : surfels)
    radii.push_back(all.radii[i]);
  if (radii.empty())
    return 0;
  const auto chosen =
      radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / kDense);
  std::nth_element(radii.begin(), chosen, radii.end());
  return *chosen * std::sqrt(static_cast<float>(M_PI / Surfels::kNeighbours));
}

float
concavityOf(const Surfels& surfels, std::uint32_t i, std::uint32_t j)
{
  const Eigen::Vector3f chord = (surfels.points[j] - surfels.points[i]).normalized();
  return (surfels.normals[i] - surfels.normals[j]).dot(chord) / 2;
}

SurfelSets
setsOf(Components& components, const std::vector<char>& mask)
{
  SurfelSets sets;
  std::vector<std::size_t> set_of(mask.size());
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (!mask[i])
      continue;
    const std::size_t first = components.firstOf(i);
    if (first == i) {
      set_of[i] = sets.size();
      sets.emplace_back();
    }
    sets[set_of[first]].push_back(static_cast<std::uint32_t>(i));
  }
  return sets;
}

void
joinAdjacent(const SurfelGraph& graph,
             const std::vector<char>& mask,
             Components& components)
{
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (auto k = graph.begin[i]; mask[i] && k < graph.begin[i + 1]; ++k)
      if (graph.links[k].adjacent && mask[graph.links[k].other])
        components.join(i, graph.links[k].other);
}

/** Joins surfels on one plane that are less than about a cell apart. */
void
joinOnPlanes(const PlaneCloud& cloud,
             const SurfelGraph& graph,
             const SceneSupports& supports,
             Components& components)
{
  constexpr double kCell = 0.25; // [m]
  std::map<std::uint32_t, std::unordered_map<VoxelKey, std::size_t>> cells;
  for (std::size_t i = 0; i < graph.size(); ++i) {
    const auto plane = supports.plane_of_surfel[graph.surfels[i]];
    if (plane == SceneSupports::kNoPlane)
      continue;
    const Eigen::Vector3f& place = cloud.surfels().points[graph.surfels[i]];
    auto& own = cells[plane];
    for (int n = 0; n < 27; ++n) {
      const Eigen::Vector3f step(n % 3 - 1.F, n / 3 % 3 - 1.F, n / 9 - 1.F);
      const auto found = own.find(voxelKey(place + float(kCell) * step, kCell));
      if (found != own.end())
        components.join(i, found->second);
    }
    own.emplace(voxelKey(place, kCell), i);
  }
}
} // namespace

SurfelGraph
linkSurfels(const PlaneCloud& cloud,
            std::vector<std::uint32_t> surfels,
            double angular_spacing,
            const ProposalOptions& options)
{
  const Surfels& all = cloud.surfels();
  const Points points = placesOf(all, surfels);
  const PointTree tree(points, options.num_threads);
  const float least = leastSpacing(all, surfels);
  const auto gap = static_cast<float>(options.gap);
  SurfelGraph graph;
  for (const auto i : surfels) {
    const Eigen::Vector3f ray =
        all.points[i] - cloud.viewpoint(all.members[all.begin[i]]);
    graph.spacings.push_back(
        std::max(least, static_cast<float>(angular_spacing) * ray.norm()));
  }
  std::vector<std::vector<SurfelLink>> links(surfels.size());
  parallelBlocks(
      surfels.size(), kEdgeBlock, options.num_threads, [&](const Block& block) {
        std::array<Neighbour, kMostLinks> near;
        for (std::size_t i = block.begin; i < block.end; ++i) {
          const std::size_t count = tree.nearestK(points[i], kMostLinks, near.data());
          for (std::size_t k = 0; k < count; ++k) {
            const auto other = static_cast<std::uint32_t>(near[k].index);
            const float distance = std::sqrt(near[k].distance_sq);
            const float spacing = std::min(graph.spacings[i], graph.spacings[other]);
            if (other == i || distance > std::max(kReach, gap) * spacing)
              continue;
            links[i].push_back({other,
                                distance,
                                concavityOf(all, surfels[i], surfels[other]),
                                distance <= gap * spacing});
          }
        }
      });
  graph.begin.push_back(0);
  for (const auto& own : links) {
    graph.links.insert(graph.links.end(), own.begin(), own.end());
    graph.begin.push_back(static_cast<std::uint32_t>(graph.links.size()));
  }
  graph.surfels = std::move(surfels);
  return graph;
}

SurfelSets
connectedSets(const PlaneCloud& cloud,
              const SurfelGraph& graph,
              const SceneSupports& supports)
{
  const std::vector<char> all(graph.size(), 1);
  Components components(graph.size());
  joinAdjacent(graph, all, components);
  joinOnPlanes(cloud, graph, supports, components);
  return setsOf(components, all);
}

SurfelSets
connectedSets(const SurfelGraph& graph, const std::vector<char>& mask)
{
  Components components(graph.size());
  joinAdjacent(graph, mask, components);
  return setsOf(components, mask);
}

} // namespace pcl6d::object_localization
