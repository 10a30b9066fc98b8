// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <cstddef>

namespace pcl6d::moving_objects {

/** \brief The tested places of a scan, with their resolution. */
struct TestedPositions {
  const Points& places;   ///< [m] in the scan's frame
  Eigen::Vector3f origin; ///< [m] of its rays
  double cell = 0;        ///< [rad] angular distance of places, seen from the origin
  double noise = 0;       ///< [m] standard deviation of a point

  /** \return the direction of a place, seen from the origin; of length 1 */
  Eigen::Vector3f
  directionOf(std::size_t place) const
  {
    return (places[place] - origin).normalized();
  }
};

} // namespace pcl6d::moving_objects
