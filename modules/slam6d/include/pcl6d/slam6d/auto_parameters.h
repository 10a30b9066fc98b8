// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Fills in what the user left open, from the first scans of a run. Derived
 * values are rounded to two digits (max_range below a code: four), so that giving the
 * printed value gives the same run. */
Slam6DParameters
deriveParameters(const Slam6DOptions& options, const std::vector<Points>& scans);

/** \brief Fills in what is known when scans were matched: how far apart the ends of a loop and
 * linked scans may be, how many scans are between the ends of a loop, and how many pairs of
 * points it needs. \param[in] scans with their poses and reduced points
 * \param[in,out] parameters with median_range and voxel */
void
deriveLoopParameters(const Slam6DOptions& options,
                     const std::vector<ScanResult>& scans,
                     Slam6DParameters& parameters);

} // namespace pcl6d
