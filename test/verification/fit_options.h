// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "verified_rooms.h"

#include <pcl6d/verification/surface_fit.h>

namespace pcl6d::test {

constexpr double kFitReach = 1.7 * kVoxel; // [m] as links pair points

/** \return options for a world scaled by a factor */
inline SurfaceFitOptions
fitOptions(double scale = 1)
{
  SurfaceFitOptions options;
  options.max_distance = scale * kFitReach;
  return options;
}

} // namespace pcl6d::test
