// SPDX-License-Identifier: BSD-3-Clause
#include "standing_things.h"

#include <pcl6d/common/components.h>
#include <pcl6d/search/point_tree.h>

#include <Eigen/Geometry>

#include <map>

namespace pcl6d::visibility {

namespace {
/** A cluster of contradicted points. */
struct Cluster {
  Eigen::AlignedBox3f box;
  std::size_t patches = 0;
  std::size_t free = 0, confirmed = 0; ///< around its points, summed
};
} // namespace

StandingThings
standingThings(const Points& free,
               const Points& confirmed,
               const std::vector<std::vector<std::size_t>>& patches,
               double reach,
               double largest)
{
  const PointTree of_free(free, 1), of_confirmed(confirmed, 1);
  const auto reach_sq = static_cast<float>(reach * reach);
  Components hanging(free.size());
  std::vector<std::size_t> around(free.size());
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto near = of_free.withinRadius(free[i], reach_sq);
    around[i] = near.size();
    for (const Neighbour& other : near)
      hanging.join(i, static_cast<std::size_t>(other.index));
  }
  for (const auto& patch : patches)
    for (const std::size_t i : patch)
      hanging.join(patch.front(), i);
  std::map<std::size_t, Cluster> clusters; // by first point
  for (const auto& patch : patches)
    ++clusters[hanging.firstOf(patch.front())].patches;
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto cluster = clusters.find(hanging.firstOf(i));
    if (cluster == clusters.end())
      continue; // in no contradicted patch
    cluster->second.box.extend(free[i]);
    cluster->second.free += around[i];
    cluster->second.confirmed += of_confirmed.withinRadius(free[i], reach_sq).size();
  }
  StandingThings found;
  for (const auto& [first, cluster] : clusters)
    if (cluster.box.diagonal().norm() <= largest && cluster.confirmed < cluster.free) {
      ++found.things;
      found.patches += cluster.patches;
    }
  return found;
}

} // namespace pcl6d::visibility
