// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/run/run_folder.h>

namespace pcl6d::app {

/** \brief How far each point of a map lies from what other scans measured: the distance to
 * the plane through the nearest eight points of the scan that saw it closest by, or to the
 * nearest one where these do not lie on a plane.
 * \return per point [m]; NaN where no other scan has a point within 0.5 m, or a scan is
 * missing \throws IoFailed a scan is broken */
std::vector<float>
mapResiduals(const RunFolder& run, const RunMap& map);

} // namespace pcl6d::app
