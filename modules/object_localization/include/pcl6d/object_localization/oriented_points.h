// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Points of surfaces with consistently oriented unit normals: outwards, or
 * towards the sensor. \ingroup object_localization */
struct OrientedPoints {
  Points points;   ///< [m]
  Normals normals; ///< one per point

  std::size_t
  size() const
  {
    return points.size();
  }
};

/** \return the mean point and normal of each occupied voxel, and of a thin sheet one
 * per face; points without a normal are left out
 * \param[in] voxel [m] > 0
 * \throws BadArgument not one normal per point, or voxel is invalid */
OrientedPoints
reduceOriented(const OrientedPoints& surface, double voxel);

} // namespace pcl6d
