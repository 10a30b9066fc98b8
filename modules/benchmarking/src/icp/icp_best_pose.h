// SPDX-License-Identifier: BSD-3-Clause
// Precision of a best pose, and the tests for accepting it.
#pragma once

#include <pcl6d/benchmarking/icp_basin.h>

namespace pcl6d::benchmarking {

/** \return the best pose from the end of a run, with its sigma and the reason of a rejection */
IcpBestPose
evaluatedBestPose(Metric metric,
                  const IcpResult& result,
                  const IcpBasinOptions& options);

/** \return whether position and orientation of a pose are within a multiple of sigma of
 * the best pose */
bool
isWithin(double sigmas, const IcpBestPose& best, const MotionSize& distance);

/** \return the reason to reject the best pose after a run from this pose ended
 * elsewhere; empty if the run returned */
std::string
doubtOfReturn(const IcpBestPose& best,
              const IcpResult& again,
              const IcpBasinOptions& options);

/** \return the pairs of accepted best poses that are too far apart */
std::vector<IcpDisagreement>
disagreementsOf(const std::vector<IcpBestPose>& best, const IcpBasinOptions& options);

} // namespace pcl6d::benchmarking
