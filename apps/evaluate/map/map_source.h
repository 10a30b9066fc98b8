// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Selection of the map to measure. */
struct MapSource {
  std::string folder;    ///< of a finished run, or of scans with poses
  std::string poses;     ///< file with KITTI or TUM rows; empty: the map's own poses
  std::string reference; ///< cloud in the map's world; may be empty
  std::optional<double> min_range; ///< [m] none: derived
  std::optional<double> max_range; ///< [m] none: derived
  std::optional<double> voxel;     ///< [m] none: derived
};

/** \brief The scans of a map in memory. */
struct LoadedMap {
  std::vector<std::string> names; ///< of their files
  std::vector<Points> scans;      ///< [m] within the range gate, in their own frames
  std::vector<Eigen::Isometry3d> poses; ///< relative to the world offset of a run
  std::string pose_source;              ///< for people
  Points reference;                     ///< [m] empty: none
  double voxel = 0;                     ///< [m] given or derived
};

/** \throws BadArgument a range or the voxel is invalid */
void
validateSource(const MapSource& source);

/** \brief Reads the scans and the reference.
 * \throws IoFailed the folder is neither a finished run nor a folder of scans with
 * poses, the run was interrupted, a file is missing or broken, or the poses are not one
 * per scan
 * \throws ComputeFailed a scan has fewer than 3 points within the range gate */
LoadedMap
loadMap(const MapSource& source, unsigned int num_threads);

} // namespace pcl6d::app
