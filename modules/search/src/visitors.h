// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/search/neighbour.h>

#include <algorithm>
#include <cstddef>
#include <vector>

/** \file
 * What a search keeps of the points that it meets, the same for every structure: here is
 * the rule for ties and limits. A structure may leave out points farther than bound(),
 * but none at exactly that distance. */
namespace pcl6d::search {

/** Keeps the nearest point within a limit. */
struct NearestVisitor {
  Neighbour best;   ///< at first: index -1 and the limit
  float shrink = 1; ///< of the squared bound once there is a point; < 1: approximate

  float
  bound() const
  {
    return best.index < 0 ? best.distance_sq : best.distance_sq * shrink;
  }
  bool
  add(int index, float distance_sq)
  {
    const bool better =
        distance_sq < best.distance_sq ||
        (distance_sq == best.distance_sq && best.index >= 0 && index < best.index);
    if (better)
      best = {index, distance_sq};
    return better;
  }
  Neighbour
  result() const
  {
    return best.index < 0 ? Neighbour() : best;
  }
};

/** Keeps the nearest points within a radius, at most max_count of them: once there are
 * so many as a heap, the farthest in front; a short one is kept sorted, which is faster.
 */
struct CollectVisitor {
  static constexpr std::size_t kShort = 64;
  float radius_sq;       ///< a point at exactly this distance is not accepted
  std::size_t max_count; ///< > 0
  float shrink = 1;      ///< as above, once there are max_count points
  std::vector<Neighbour> found{};

  /** \return the distance beyond which a point is of no use */
  float
  worst() const
  {
    return found.size() < max_count ? radius_sq : found.front().distance_sq;
  }
  float
  bound() const
  {
    return found.size() < max_count ? radius_sq : worst() * shrink;
  }
  void
  add(int index, float distance_sq)
  {
    const Neighbour candidate{index, distance_sq};
    if (found.size() < max_count) {
      if (!(distance_sq < radius_sq))
        return;
      found.push_back(candidate);
      if (found.size() == max_count)
        std::sort(found.rbegin(), found.rend());
    }
    else if (candidate < found.front())
      replaceFarthest(candidate);
  }
  std::vector<Neighbour>
  result()
  {
    std::sort(found.begin(), found.end());
    return std::move(found);
  }

private:
  void
  replaceFarthest(const Neighbour& candidate)
  {
    if (max_count > kShort) {
      std::pop_heap(found.begin(), found.end());
      found.back() = candidate;
      std::push_heap(found.begin(), found.end());
      return;
    }
    auto place = found.begin();
    for (; place + 1 != found.end() && candidate < place[1]; ++place)
      *place = place[1];
    *place = candidate;
  }
};

} // namespace pcl6d::search
