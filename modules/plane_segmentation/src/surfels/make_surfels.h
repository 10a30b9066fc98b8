// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "surfels/grid_links.h"

#include <pcl6d/plane_segmentation/surfels.h>

#include <functional>

namespace pcl6d::plane_segmentation {

/** \brief Groups points into surfels and finds the neighbours of each. \param[in] voxel
 * [m] edge length of a surfel's cell \param[in] grid of an organized cloud, defines
 * neighbours; without width: no grid \throws BadArgument see voxelKey() */
Surfels
groupSurfels(const Points& points,
             double voxel,
             const PointGrid& grid,
             unsigned int num_threads);

/** \brief Fits a plane to the neighbours of each surfel. Uses fewer neighbours where
 * only the nearer ones are coplanar, for example on a narrow strip or next to an edge.
 * Moves smooth surfels onto their planes, which averages the noise of some twenty
 * surfels.
 * \param[in] viewpoint_of [m] of a surfel
 * \param[in,out] surfels with their noise */
void
fitSurfels(Surfels& surfels,
           const std::function<Eigen::Vector3f(std::size_t)>& viewpoint_of,
           unsigned int num_threads);

} // namespace pcl6d::plane_segmentation
