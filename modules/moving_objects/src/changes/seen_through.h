// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surface_distances.h"

#include <pcl6d/moving_objects/run_changes.h>

#include <cstdint>
#include <vector>

namespace pcl6d::moving_objects {

/** \brief A voxel of a run with violations by the other run at most of its points. */
struct GoneVoxel {
  Eigen::Vector3f place = Eigen::Vector3f::Zero(); ///< [m] mean of the violated points
  std::uint32_t points = 0;
  std::uint32_t num_observers = 0; ///< largest number of violating scans of a point
  bool on_fringe = false;          ///< next to unchanged points
};

/** \brief The changes of one run against the other. */
struct SeenThrough {
  std::vector<GoneVoxel> gone; ///< in the order of the scans
  Points there;                ///< [m] of the voxels with mostly unchanged points
  Points unknown;              ///< [m] of the voxels without a result
  RunTally tally;
};

/** \brief Tests every point of a run by the surfaces and the rays of another run. */
SeenThrough
seenThrough(const SurfacedRun& of,
            const SurfacedRun& by,
            const RunChangesOptions& options);

} // namespace pcl6d::moving_objects
