// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cmath>

namespace PCL6D_EXPORTS pcl6d {

inline constexpr double kDegree = M_PI / 180; ///< [rad]

constexpr double
radians(double degrees)
{
  return kDegree * degrees;
}

constexpr double
degrees(double radians)
{
  return 180 / M_PI * radians;
}

} // namespace pcl6d
