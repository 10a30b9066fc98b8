// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scene_interpretation/interpretation.h>
#include <pcl6d/scene_interpretation/scene_plane.h>

#include <vector>

/** \file Storeys of a building. Internal to the module scene_interpretation. */
namespace pcl6d::scene_interpretation {

/** \brief Finds the storeys, the storey of each plane, and for each plane the heights
 * of the storey's floor and of the ceiling above. */
void
findStoreys(std::vector<ScenePlane>& planes,
            const InterpretationOptions& options,
            Interpretation& result);

} // namespace pcl6d::scene_interpretation
