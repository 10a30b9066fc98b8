// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/search/neighbour.h>

#include <limits>
#include <vector>

namespace pcl6d::test {

/** Everything that the compiled search of a tree answers, in one row. */
template <typename Tree, typename Two>
std::vector<Neighbour>
searchAll(const Points& points, const Points& queries)
{
  constexpr float kNoLimit = std::numeric_limits<float>::infinity();
  const Tree tree(points, 1, Tree::Cells::kKeep);
  std::vector<Neighbour> all;
  const auto add = [&](const auto& found) {
    all.push_back({found.index, found.distance_sq});
  };
  int leaf = -1;
  for (const auto& q : queries) {
    add(tree.nearest(q, kNoLimit));
    add(tree.nearestFrom(leaf, q, 1.0f));
    add(tree.nearestApproximate(q, kNoLimit, 2.0));
    Two two{{-1, kNoLimit}, kNoLimit};
    tree.improveTwo(q, two);
    add(two.nearest);
    all.push_back({-1, two.second_sq});
    for (const std::size_t k : {5, 10, 20, 30, 50})
      for (const auto& found : tree.nearestK(q, k))
        add(found);
    all.push_back({tree.hasNeighbour(q, 0.5f) ? 1 : 0, 0});
    for (const auto& found : tree.withinRadius(q, 1.0f))
      add(found);
  }
  return all;
}

/** The same by PointTree compiled once more, for the plainest x86-64 alone. */
std::vector<Neighbour>
plainSearchAll(const Points& points, const Points& queries);

} // namespace pcl6d::test
