// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Points of surfaces with unit normals that all point to the outside, or to the
 * sensor. \ingroup object_localization */
struct OrientedPoints {
  Points points;   ///< [m]
  Normals normals; ///< one per point

  std::size_t
  size() const
  {
    return points.size();
  }
};

/** \return the mean point and normal of each occupied voxel, and of a thin sheet one of
 * each face; points without a normal are left out
 * \throws BadArgument not one normal per point, or voxel breaks its rule */
OrientedPoints
reduceOriented(const OrientedPoints& surface, double voxel);

} // namespace pcl6d
