// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

namespace PCL6D_EXPORTS pcl6d {

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

/** \brief The nearest point and how near any other one comes; see
 * PointTree::improveTwo(). */
struct TwoNearest {
  Neighbour nearest;   ///< index -1: none within nearest.distance_sq
  float second_sq = 0; ///< squared distance of the next [m^2]; at first the limit
};

/** \return the squared distance of two points [m^2] with the bits of all searches:
 * squares are summed in the order x, y, z, in float, everywhere */
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
