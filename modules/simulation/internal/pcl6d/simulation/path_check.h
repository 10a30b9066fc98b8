// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/robot_path.h>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Checks that a robot can drive a path and scan from it.
 *
 * Every 0.1 m of the way must be free at the height of the sensor and at half the
 * height. At the scans, the sensor must not be inside a solid body.
 * \param[in] num_scans evenly along the path
 * \throws ComputeFailed naming the scan, the position in the scene and the blocking
 * surface \ingroup simulation */
void
requireFreePath(const RayCaster& caster, const RobotPath& path, int num_scans);

} // namespace pcl6d
