// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "planes/distance_field.h"

#include <Eigen/Core>

#include <vector>

namespace pcl6d::plane_segmentation {

using Ring = std::vector<Eigen::Vector2d>;

/** \brief Level lines of a raster: closed rings with larger values on their left, so
 * islands run counter-clockwise and lakes clockwise. Marching squares; two islands that
 * touch at a corner stay apart. \return in cells, centres of cells at whole numbers.
 * \param[in] field its rim must be below the level */
std::vector<Ring>
contours(const Raster<float>& field, float level);

/** \brief Drops corners, within a tolerance from the ring.
 * \note Source: D. H. Douglas, T. K. Peucker, Cartographica 10(2), 1973. */
Ring
simplified(const Ring& ring, double tolerance);

/** \return the islands, largest first, each followed by its lakes */
std::vector<Ring>
nested(std::vector<Ring> rings);

} // namespace pcl6d::plane_segmentation
