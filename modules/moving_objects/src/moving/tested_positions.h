// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <cstddef>
#include <vector>

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

  /** \return [m] distance of neighbouring rays at a place */
  double
  spacingAt(std::size_t place) const
  {
    return cell * (places[place] - origin).norm();
  }
};

/** \return [m] the mean of some places */
inline Eigen::Vector3d
middleOf(const TestedPositions& observed, const std::vector<std::size_t>& some)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::size_t place : some)
    sum += observed.places[place].cast<double>();
  return sum / static_cast<double>(some.size());
}

} // namespace pcl6d::moving_objects
