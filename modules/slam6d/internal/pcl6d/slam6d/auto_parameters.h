// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Derives the options without a given value from the first scans of a run. Derived values
 * are rounded to two digits (max_range below a code: four): giving the printed value reproduces
 * the run. */
Slam6DParameters
deriveParameters(const Slam6DOptions& options, const std::vector<Points>& scans);

/** \brief Derives the parameters that require matched scans: largest distances of loop ends and of
 * linked scans, number of scans between the ends of a loop, and number of point pairs of a loop.
 * \param[in] scans with their poses and reduced points
 * \param[in,out] parameters with median_range and voxel */
void
deriveLoopParameters(const Slam6DOptions& options,
                     const std::vector<ScanResult>& scans,
                     Slam6DParameters& parameters);

} // namespace pcl6d
