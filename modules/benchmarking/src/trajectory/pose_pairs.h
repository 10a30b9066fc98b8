// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/pose_matching.h>

namespace pcl6d::benchmarking {

/** \throws BadArgument a pair points outside a trajectory */
void
checkPairs(const Trajectory& estimate,
           const Trajectory& reference,
           const std::vector<PosePair>& pairs);

/** \return the length of the reference path from the first compared pose to each [m] */
std::vector<double>
pathsTo(const Trajectory& reference, const std::vector<PosePair>& pairs);

} // namespace pcl6d::benchmarking
