// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/plane_score.h>
#include <pcl6d/common/points.h>

#include <memory>
#include <vector>

namespace pcl6d::benchmarks {

/** \brief A scan of which the planes are known. */
struct PlaneScan {
  Points points;             ///< [m]; NaN without return
  PlaneNumbers truth;        ///< of each point
  std::vector<Plane> planes; ///< in the frame of the scan
};

/** \return the first scans of the built-in rooms of seeds 1 to 10, 1 cm noise */
std::vector<PlaneScan>
simulatedRooms();

/** \return the points of kurt3d/scan001 between 0.2 m and 32 m; null: not there */
std::shared_ptr<const Points>
kurt3dScan();

} // namespace pcl6d::benchmarks
