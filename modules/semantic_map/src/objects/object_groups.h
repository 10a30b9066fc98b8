// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/semantic_map/object_fusion.h>

#include <vector>

/** \file Which observations are of one object. Internal to the module semantic_map. */
namespace pcl6d::semantic_map {

/** \return how well the places of two objects agree: intersection over union of their
 * boxes; without boxes what is left of max_distance, as a share; in [0, 1] */
double
overlapOf(const MapObject& a, const MapObject& b, double max_distance);

/** \return places of the observations of each object, ascending; the objects by their first
 * observation */
std::vector<std::vector<std::size_t>>
groupObservations(const std::vector<MapObject>& observations,
                  const FusionOptions& options);

} // namespace pcl6d::semantic_map
