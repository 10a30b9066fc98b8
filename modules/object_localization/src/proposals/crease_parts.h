// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "proposals/surfel_graph.h"

/** \file Pieces of a group of surfels. Internal to the module object_localization. */
namespace pcl6d::object_localization {

/** \brief Divides a group along the creases into which its surface bends, as where a box
 * stands on another. What a crease encloses from within, as the bottom of a pot, stays
 * with what is around it.
 * \param[in] group places in the graph, ascending
 * \return the pieces, one if nothing divides it; disjoint, and all of the group */
SurfelSets
divideAtCreases(const PlaneCloud& cloud,
                const SurfelGraph& graph,
                const std::vector<std::uint32_t>& group,
                const ProposalOptions& options);

} // namespace pcl6d::object_localization
