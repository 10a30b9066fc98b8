// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sight_votes.h"
#include "tested_positions.h"

#include <pcl6d/search/point_tree.h>

#include <cstddef>
#include <cstdint>
#include <vector>

/** \file Clusters of points that are less accurate than their scan as a whole: the noise of a depth
 * camera grows with the square of the range, and with the inverse of the returned light. */
namespace pcl6d::moving_objects {

/** \return whether the noise of its points explains a cluster. The noise at a place is measured by the
 * distances of its nearest places from their plane. Two cases:
 * - most of the misses are misses no longer if this noise is added to the uncertainty of the places;
 * - no surface is resolved: the nearest places of most places are as thick as wide, and thicker than
 *   their spacing. Ranges beyond the ambiguity interval of a phase camera look so.
 * \param[in] tree over all places
 * \param[in] telling observers whose misses count, a bit for each */
bool
isNoise(const TestedPositions& observed,
        const ObserverVotes& votes,
        const PointTree& tree,
        const std::vector<std::size_t>& cluster,
        std::uint16_t telling);

} // namespace pcl6d::moving_objects
