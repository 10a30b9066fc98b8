// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/plane.h>
#include <pcl6d/common/points.h>

#include <vector>

namespace pcl6d {

/** \return the planes of one scan in the world, normals towards the scanner
 * \param[in] points [m] finite, in the scan's frame, the scanner at the origin */
std::vector<Plane>
planesOfScan(const Points& points, const Eigen::Isometry3d& T_world_scan);

} // namespace pcl6d
