// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/search/neighbour.h>

#include <algorithm>
#include <cstddef>
#include <vector>

/** \file
 * Results of a search, common to every structure: the rule for ties and limits is here. A
 * structure may leave out points farther than bound(), but not a point at exactly bound(). */
namespace pcl6d::search {

/** Keeps the nearest point within a limit. */
struct NearestVisitor {
  Neighbour best;   ///< at first: index -1 and the limit
  float shrink = 1; ///< of the squared bound, once a point is found; < 1: approximate

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

/** Keeps the nearest points within a radius, at most max_count: from max_count on in a heap, the
 * farthest in front; a short list is kept sorted, which is faster.
 */
struct CollectVisitor {
  static constexpr std::size_t kShort = 64;
  float radius_sq;       ///< a point at exactly this distance is not accepted
  std::size_t max_count; ///< > 0
  float shrink = 1;      ///< as above, from max_count points on
  std::vector<Neighbour> found{};

  /** \return the distance beyond which a point does not matter */
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
