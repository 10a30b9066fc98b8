// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/mcl_evaluation.h"

#include <pcl6d/common/trajectory.h>

#include <string>

namespace pcl6d::app {

/** \brief Compares the localised poses with a reference, in the map.
 * \param[in] reference one pose per scan, in the world of the odometry */
MclErrors
mclErrors(const MclEvaluation& e, const Trajectory& reference, bool only_trusted);

/** \return the poses of a reference that belong to the scans
 * \throws IoFailed the file is broken or holds not one pose per scan */
Trajectory
readMclReference(const std::string& file, const ScanFolder& folder);

} // namespace pcl6d::app
