// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/output/output_folder.h"

#include <pcl6d/simulation/simulator.h>
#include <pcl6d/simulation/truth_fields.h>

namespace pcl6d::app {

/** \brief Writes planes_truth.json and objects_truth.json in the world of the scans.
 * \param[in] scene the simulated scene
 * \param[in] counts points of every scan */
void
writeTruthFiles(const OutputFolder& folder,
                const SimulationScene& scene,
                const Simulator& simulator,
                const TruthCounts& counts);

} // namespace pcl6d::app
