// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "proposals/surfel_graph.h"

/** \file Pieces of a group of surfels. Internal to the module object_localization. */
namespace pcl6d::object_localization {

/** \brief Divides a group at concave creases, for example where a box stands on
 * another. A surface enclosed by a crease, such as the bottom of a pot, stays with its
 * surroundings.
 * \param[in] group indices into the graph, ascending
 * \return the pieces, disjoint and complete; the group itself if no crease divides
 * it */
SurfelSets
divideAtCreases(const PlaneCloud& cloud,
                const SurfelGraph& graph,
                const std::vector<std::uint32_t>& group,
                const ProposalOptions& options);

} // namespace pcl6d::object_localization
