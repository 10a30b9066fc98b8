// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface_distances.h"

#include <pcl6d/moving_objects/run_changes.h>

#include <cstdint>
#include <vector>

namespace pcl6d::moving_objects {

/** \brief A voxel of a run most of whose points another run saw through. */
struct GoneVoxel {
  Eigen::Vector3f place = Eigen::Vector3f::Zero(); ///< [m] mean of these points
  std::uint32_t points = 0;
  std::uint32_t witnesses = 0; ///< scans that saw through one of them, at most
  bool on_fringe = false;      ///< what is there still is next to it
};

/** \brief What of a run is gone. */
struct SeenThrough {
  std::vector<GoneVoxel> gone; ///< in the order in which the scans have them
  Points there;                ///< [m] of the voxels of which most is there still
  Points unknown;              ///< [m] of those of which nothing is known
  RunTally tally;
};

/** \brief Asks the surfaces and the rays of another run for every point of a run. */
SeenThrough
seenThrough(const SurfacedRun& of,
            const SurfacedRun& by,
            const RunChangesOptions& options);

} // namespace pcl6d::moving_objects
