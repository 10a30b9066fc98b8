// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/semantic_map/object_fusion.h>

#include <vector>

/** \file Groups observations by object. Internal to the module semantic_map. */
namespace pcl6d::semantic_map {

/** \return the agreement of two objects' positions: intersection over union of their
 * boxes; without boxes 1 - distance / max_distance; in [0, 1] */
double
overlapOf(const MapObject& a, const MapObject& b, double max_distance);

/** \return indices of the observations of each object, ascending; objects in the order
 * of their first observation */
std::vector<std::vector<std::size_t>>
groupObservations(const std::vector<MapObject>& observations,
                  const FusionOptions& options);

} // namespace pcl6d::semantic_map
