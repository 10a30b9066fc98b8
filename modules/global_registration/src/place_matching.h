// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/icp.h>

namespace pcl6d::global_registration {

/** \return how places are matched: as Slam6D matches scans, on one thread
 * \param[in] voxel [m] of the scans \param[in] start [m] how far off pairs may be at first */
IcpOptions
matchingOptions(double voxel, double start);

} // namespace pcl6d::global_registration
