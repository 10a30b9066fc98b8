// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/interrupt.h"
#include "common/progress_bar.h"
#include "planes/plane_step.h"

#include <optional>

namespace pcl6d::app {

/** \brief Reads the cloud to look for planes in: a scan as it is, without what lies
 * outside the range gate; of a folder one point per voxel of the map.
 * \return nothing if interrupted
 * \throws IoFailed as readScan() and RegisteredScans
 * \throws UsageError the options select no scan, or give poses for a run */
std::optional<PlaneStepCloud>
readPlaneInput(const PlaneSettings& settings,
               ProgressBar& bar,
               const Interrupt& interrupt);

} // namespace pcl6d::app
