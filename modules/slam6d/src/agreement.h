// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/icp.h>

namespace pcl6d {

/** \return the share of the finite points (of many, a sample) that have a point of the target within a
 * distance [m], in [0, 1]; 0 without a finite point. The same for any number of threads. */
double
agreementOf(const IcpTarget& target,
            const Points& points,
            const Eigen::Isometry3d& T_target_points,
            double distance,
            unsigned int num_threads);

} // namespace pcl6d
