// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan at its pose in the map: static points, and origin of the rays. */
struct MappedScan {
  Points points; ///< [m] in the frame of the map; finite
  Eigen::Vector3f origin =
      Eigen::Vector3f::Zero(); ///< [m] of the scanner, in the frame of the map
  /** false: the cloud is not centred on the scanner; the rays are not known and only the points
   * count */
  bool has_rays = true;
};

/** \brief State of a cell of a map. */
enum class CellState : unsigned char {
  kUnknown, ///< no ray went through the cell
  kFree,    ///< rays went through the cell
  kOccupied ///< a surface was measured in the cell
};

} // namespace pcl6d
