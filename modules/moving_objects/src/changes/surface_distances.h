// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "run_surface.h"

#include <pcl6d/moving_objects/surface_distance.h>

#include <vector>

namespace pcl6d::moving_objects {

/** \brief A run with its surface. */
struct SurfacedRun {
  const ComparedRun& run;
  const RunSurface& surface;
};

/** \brief pcl6d::surfaceDistances() of runs with given surfaces. */
std::vector<SurfaceDistance>
distancesBetween(const SurfacedRun& of,
                 const SurfacedRun& to,
                 const SurfaceDistanceOptions& options);

} // namespace pcl6d::moving_objects
