// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pcl6d {

/** \brief A point found by a search. */
struct Neighbour {
  int index = -1;        ///< place in the points that were searched; -1: none
  float distance_sq = 0; ///< squared distance to the query [m^2]
};

/** \brief The order of all results: nearer first, ties by index. */
inline bool
operator<(const Neighbour& a, const Neighbour& b)
{
  return a.distance_sq < b.distance_sq ||
         (a.distance_sq == b.distance_sq && a.index < b.index);
}

} // namespace pcl6d
