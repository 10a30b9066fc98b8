// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/plane_segmentation/surfels.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl6d::plane_segmentation {

/** \brief The grid of an organized cloud. */
struct PointGrid {
  std::size_t width = 0; ///< points in a row
  /** per point its index in the cloud, row by row; refers to data of the caller */
  const std::vector<std::uint32_t>* places = nullptr;
};

/** \brief Finds the neighbours of each surfel by the grid of an organized cloud:
 * surfels with adjacent points, the surfels adjacent to these, and so on; keeps the
 * nearest. A surface that is close in space but not in the grid is no neighbour.
 * \param[in,out] surfels grouped; gets radii, links and link_begin */
void
linkByGrid(Surfels& surfels, const PointGrid& grid, unsigned int num_threads);

} // namespace pcl6d::plane_segmentation
