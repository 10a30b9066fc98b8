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

} // namespace pcl6d
