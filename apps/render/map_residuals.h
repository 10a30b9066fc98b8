// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/run/run_folder.h>

namespace pcl6d::app {

/** \brief Residual of each point of a map: distance to the plane through the nearest
 * eight points of the other scan with the nearest point; if the eight points are not
 * planar, the distance to the nearest point.
 * \return per point [m]; NaN if no other scan has a point within 0.5 m, or a scan is
 * missing \throws IoFailed a scan is broken */
std::vector<float>
mapResiduals(const RunFolder& run, const RunMap& map);

} // namespace pcl6d::app
