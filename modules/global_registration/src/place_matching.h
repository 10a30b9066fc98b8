// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/icp.h>

namespace pcl6d::global_registration {

/** \return how places are matched: as Slam6D matches scans, on one thread
 * \param[in] voxel [m] of the scans \param[in] start [m] how far off pairs may be at first */
IcpOptions
matchingOptions(double voxel, double start);

/** \return how a place that was found is matched by all points, until nothing moves
 * \param[in] voxel [m] of the scans */
IcpOptions
fineOptions(double voxel, unsigned int num_threads);

} // namespace pcl6d::global_registration
