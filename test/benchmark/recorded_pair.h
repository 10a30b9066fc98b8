// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace pcl6d::benchmarks {

/** \brief Two recorded scans, gated and reduced, and how they are to be matched. */
struct RecordedPair {
  std::string name;        ///< such as "kurt3d-000-001"
  Points target;           ///< [m] the earlier scan, in its own frame
  Points source;           ///< [m] the later one, in its own frame
  Eigen::Isometry3d guess; ///< T_target_source, from the poses of the recording
  double gate = 0;         ///< [m] largest pair distance
};

/** \return the pairs of the recorded data that are there: kurt3d 000/001 (10 cm voxels),
 * rooms 1/2 (5 cm), hku1 30/31 (20 cm); from $PCL6D_DATA or ../shared/data */
std::vector<RecordedPair>
recordedPairs();

} // namespace pcl6d::benchmarks
