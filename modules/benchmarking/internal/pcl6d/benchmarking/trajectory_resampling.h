// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/trajectory.h>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The poses of a trajectory at other times: positions linear, rotations at
 * constant speed (slerp) between the two poses around each time.
 * \param[in] trajectory with increasing stamps
 * \param[in] stamps [s] increasing
 * \param[in] max_gap [s] between the two poses; > 0, may be infinite
 * \return poses with their stamps; times before the first pose, after the last pose or
 * in a larger gap are left out, unless a pose has exactly the stamp
 * \throws BadArgument no stamps, stamps do not increase, or max_gap is invalid
 * \ingroup benchmarking */
Trajectory
resample(const Trajectory& trajectory,
         const std::vector<double>& stamps,
         double max_gap);

} // namespace pcl6d
