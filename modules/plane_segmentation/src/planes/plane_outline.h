// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/plane_segmentation/plane_segment.h>

#include <vector>

namespace pcl6d::plane_segmentation {

/** \brief Gives a segment its hulls and area: Plane::hull, Plane::area and outline.
 *
 * The outline closes gaps between points that a disc of some radius does not fit into:
 * the boundary of the union of such discs about the points, moved back by their radius
 * (morphological closing, near to an alpha shape), and on by half the distance between
 * points, as the surface does not end at the outermost ones. Made on a raster of a
 * quarter of the radius. Corners are exact to about that.
 * \param[in,out] segment with its plane oriented
 * \param[in] places [m] its points
 * \param[in] radius [m] of the disc, > 0 */
void
addHulls(PlaneSegment& segment,
         const std::vector<Eigen::Vector3d>& places,
         double radius);

} // namespace pcl6d::plane_segmentation
