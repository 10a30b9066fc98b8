// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tested_positions.h"

#include <pcl6d/visibility/ray_image.h>

#include <cstddef>
#include <vector>

namespace pcl6d::moving_objects {

/** \return whether a cluster may consist of returns of beams that hit two surfaces. Such points lie
 * between a nearer and a farther surface, on neither, in a row along the edge of the nearer one; rays
 * of other scans pass there. The image of the own scan tells of nearer and farther surfaces within one
 * cell around a cell, so the row is narrower than these cells. The finest cells are as narrow as the
 * beam, and need no such limit: rows that follow a bent edge, or both edges of a post, are wide. Nor
 * do the next wider cells, if no place of the cluster is inside of a surface: beams that pass glass in
 * part give such points all over a pane.
 * \param[in] cluster numbers of places */
bool
areMixedReturns(const TestedPositions& observed,
                const RayImage& own,
                const std::vector<std::size_t>& cluster);

} // namespace pcl6d::moving_objects
