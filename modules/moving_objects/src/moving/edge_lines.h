// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tested_positions.h"

#include <cstddef>
#include <vector>

namespace pcl6d::moving_objects {

/** \brief Which objects are a single line of cells, seen from the scanner, like the edge of a table.
 *
 * The scanner sees the top of a table at a flat angle, so the last row of points lies along the
 * edge, and rays of other scans pass beside the edge, by the error of the poses. A line counts
 * only if most of its places have other places beside them: points that were thinned out are lines
 * for want of points.
 * \param[in] object of each place, from 0; negative: none
 * \param[in] count of the objects
 * \return one per object */
std::vector<bool>
areEdgeLines(const TestedPositions& observed,
             const std::vector<int>& object,
             std::size_t count,
             unsigned int num_threads);

} // namespace pcl6d::moving_objects
