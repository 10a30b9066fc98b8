// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/object_localization/oriented_points.h>
#include <pcl6d/plane_segmentation/plane_cloud.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The surface of a scan in elements of one size, with search trees. Marks
 * elements on planes too large for an object: floor, walls, tables.
 * \ingroup object_localization */
struct SceneSurface {
  /** \param[in] points [m] of the scan
   * \param[in] voxel [m] size of an element
   * \param[in] diameter [m] of the object: a plane is large if the whole object fits on
   * it
   * \param[in] num_threads 0: one per core; never changes the result */
  SceneSurface(const Points& points,
               double voxel,
               double diameter,
               unsigned int num_threads);

  /** \return the elements that are on no large plane */
  OrientedPoints
  withoutLargePlanes() const;

  PlaneCloud cloud;
  OrientedPoints elements;  ///< the surfels of the cloud
  PointTree tree;           ///< over the elements
  PointTree directions;     ///< over the unit vectors from the scanner to the elements
  std::vector<float> noise; ///< [m] per element: two standard deviations, averaged
  std::vector<char> large;  ///< per element: whether it is on a large plane
};

} // namespace pcl6d
