// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visibility/ray_image.h>

#include <cmath>
#include <cstddef>
#include <ostream>

namespace pcl6d {

/** For GoogleTest. */
inline void
PrintTo(Sight sight, std::ostream* os)
{
  *os << toString(sight);
}

} // namespace pcl6d

namespace pcl6d::test {

/** \return the i-th of n directions that are spread evenly over the sphere (golden angle),
 * about sqrt(4 pi / n) [rad] apart */
inline Eigen::Vector3d
directionOf(std::size_t i, std::size_t n)
{
  const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n);
  const double turn = static_cast<double>(i) * M_PI * (3 - std::sqrt(5.0));
  const double r = std::sqrt(1 - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

/** \return a scan of n rays from an origin in all directions; range(direction) [m] tells
 * how far each goes, 0 for no return */
template <typename Range>
Points
scanAround(std::size_t n, const Eigen::Vector3d& origin, Range range)
{
  Points points;
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d direction = directionOf(i, n);
    const double r = range(direction);
    if (r > 0)
      points.push_back((origin + r * direction).cast<float>());
  }
  return points;
}

/** Half a step of the codes of ranges, as share of the range: the image keeps no more. */
constexpr double kCodeTol = 0.5 / 1400;

} // namespace pcl6d::test
