// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/plane_segmentation/plane_segment.h>

#include <vector>

namespace pcl6d::plane_segmentation {

/** \brief Computes hulls and area of a segment: Plane::hull, Plane::area and outline.
 *
 * The outline closes gaps between points that are too narrow for a disc of the given
 * radius: the boundary of the union of discs about the points, moved back by the radius
 * (morphological closing, similar to an alpha shape). It is then moved out by half the
 * point spacing, as the surface extends beyond the outermost points. Computed on a
 * raster of a quarter of the radius, which is about the accuracy of the corners.
 * \param[in,out] segment with its plane oriented
 * \param[in] places [m] its points
 * \param[in] radius [m] of the disc, > 0 */
void
addHulls(PlaneSegment& segment,
         const std::vector<Eigen::Vector3d>& places,
         double radius);

} // namespace pcl6d::plane_segmentation
