// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/icp.h>

namespace pcl6d::global_registration {

/** \return options for matching a candidate pose: as Slam6D matches scans, on one thread
 * \param[in] voxel [m] of the scans
 * \param[in] start [m] largest distance of pairs at first */
IcpOptions
matchingOptions(double voxel, double start);

/** \return options for matching every point from a pose that was found, until convergence
 * \param[in] voxel [m] of the scans */
IcpOptions
fineOptions(double voxel, unsigned int num_threads);

} // namespace pcl6d::global_registration
