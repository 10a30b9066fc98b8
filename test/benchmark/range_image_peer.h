// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/moving_objects/point_motion.h>

#include <Eigen/Geometry>

#include <vector>

namespace pcl6d::bench {

/** \brief The map in the range images of the scans, after G. Kim, A. Kim, "Remove, then revert:
 * static point cloud map construction using multiresolution range images", IROS 2020.
 *
 * The map is the union of all scans, a point for each 5 cm; the images hold the nearest range of
 * a scan in each pixel. A map point is nearer than what a scan measured in its pixel by more than
 * 5 % of that range (seen through), or within that of it (seen), or farther. Remove: with 2.5,
 * 2.0 and 1.5 pixels per degree, the published values, points that were seen through more often
 * than seen. Revert: those of them that are not at 1.0 and at 0.7 pixels per degree, where the
 * ground, edges and the errors of poses share a pixel with what is nearest.
 *
 * Fields of view: the images are of all directions, and pixels in which a scan measured nothing
 * say nothing, so those of narrow scanners do. */
std::vector<std::vector<PointMotion>>
removeAndRevert(const std::vector<Points>& scans,
                const std::vector<Eigen::Isometry3d>& T_world_scan);

/** \brief The same without reverting. */
std::vector<std::vector<PointMotion>>
removeByImages(const std::vector<Points>& scans,
               const std::vector<Eigen::Isometry3d>& T_world_scan);

} // namespace pcl6d::bench
