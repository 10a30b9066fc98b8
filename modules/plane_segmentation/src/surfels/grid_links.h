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
  /** of each point its place in the cloud, row by row; refers to what its maker owns */
  const std::vector<std::uint32_t>* places = nullptr;
};

/** \brief Finds the neighbours of each surfel by the grid of an organized cloud: those
 * whose points are next to its own, those next to these, and so on; of them the nearest.
 * A surface that is close in space but elsewhere in the picture is none.
 * \param[in,out] surfels grouped; gets radii, links and link_begin */
void
linkByGrid(Surfels& surfels, const PointGrid& grid, unsigned int num_threads);

} // namespace pcl6d::plane_segmentation
