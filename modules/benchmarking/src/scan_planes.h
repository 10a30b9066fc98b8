// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/plane_segmentation/plane_segment.h>

#include <vector>

namespace pcl6d {

/** \return the planes of one scan, laid into the world
 * \param[in] points [m] finite, in the scan's frame, the scanner at the origin */
std::vector<PlaneSegment>
planesOfScan(const Points& points, const Eigen::Isometry3d& T_world_scan);

} // namespace pcl6d
