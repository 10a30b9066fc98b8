// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sight_votes.h"
#include "tested_positions.h"

#include <pcl6d/search/point_tree.h>

#include <cstddef>
#include <vector>

namespace pcl6d::moving_objects {

/** \brief Which objects are pieces of a larger surface with gaps for rays, like a pane of glass that
 * returns one ray in five.
 *
 * A piece has no place inside of a surface (hasSolidPart()). On the plane of most of its places lie
 * places of no object, at least two for each place of the piece, on three sides at least. A body stands
 * alone, on the ground: its surface ends at its outline.
 * \param[in] object of each place, from 0; negative: none
 * \param[in] count of the objects
 * \param[in] tree over all places
 * \return one per object */
std::vector<bool>
areFragments(const TestedPositions& observed,
             const SeenScan& scan,
             const std::vector<int>& object,
             std::size_t count,
             const PointTree& tree);

} // namespace pcl6d::moving_objects
