// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A point found by a search. */
struct Neighbour {
  int index = -1;        ///< in the searched points; -1: not found
  float distance_sq = 0; ///< squared distance to the query [m^2]
};

/** \brief The order of results: nearer first, ties by index. */
inline bool
operator<(const Neighbour& a, const Neighbour& b)
{
  return a.distance_sq < b.distance_sq ||
         (a.distance_sq == b.distance_sq && a.index < b.index);
}

/** \brief The nearest point, and the distance of the second nearest; see
 * PointTree::improveTwo(). */
struct TwoNearest {
  Neighbour nearest;   ///< index -1: no point within nearest.distance_sq
  float second_sq = 0; ///< squared distance of the next [m^2]; at first the limit
};

/** \return the squared distance of two points [m^2]; every search sums the squares in
 * the order x, y, z, in float, hence to the same bits */
inline float
distanceSq(const Eigen::Vector3f& a, const Eigen::Vector3f& b)
{
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const float d = a[axis] - b[axis];
    sum += d * d;
  }
  return sum;
}

} // namespace pcl6d
