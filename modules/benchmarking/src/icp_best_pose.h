// SPDX-License-Identifier: BSD-3-Clause
// What is known of a best pose: how precise it is, and whether it is to be believed.
#pragma once

#include <pcl6d/benchmarking/icp_basin.h>

namespace pcl6d::benchmarking {

/** \return the best pose that a run ended in, with its sigma and what that run says
 * against it */
IcpBestPose
judgedBestPose(Metric metric, const IcpResult& result, const IcpBasinOptions& options);

/** \return whether a pose is within so many sigma of the best one, in both parts */
bool
isWithin(double sigmas, const IcpBestPose& best, const MotionSize& distance);

/** \return why the best pose is not to be believed after a run from it ended elsewhere;
 * empty if it came back */
std::string
doubtOfReturn(const IcpBestPose& best,
              const IcpResult& again,
              const IcpBasinOptions& options);

/** \return the pairs of believed best poses that are too far apart */
std::vector<IcpDisagreement>
disagreementsOf(const std::vector<IcpBestPose>& best, const IcpBasinOptions& options);

} // namespace pcl6d::benchmarking
