// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "proposals/surfel_graph.h"

/** \file Vessels. Internal to the module object_localization. */
namespace pcl6d::object_localization {

/** \brief Joins the inside of a vessel, such as a bowl, with its outside. The rim hides
 * their connection, but no separate object faces its own middle from all around.
 * \param[in,out] sets of the graph, in the order of their first surfel, also
 * afterwards */
void
joinCavities(const PlaneCloud& cloud,
             const SurfelGraph& graph,
             const Eigen::Vector3d& up,
             SurfelSets& sets);

} // namespace pcl6d::object_localization
