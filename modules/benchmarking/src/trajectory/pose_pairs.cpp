// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/pose_pairs.h"

#include <pcl6d/common/error.h>

#include <string>

namespace pcl6d::benchmarking {

void
checkPairs(const Trajectory& estimate,
           const Trajectory& reference,
           const std::vector<PosePair>& pairs)
{
  for (const auto& pair : pairs)
    if (pair.estimate >= estimate.poses.size() ||
        pair.reference >= reference.poses.size())
      throw BadArgument("pair (" + std::to_string(pair.estimate) + ", " +
                        std::to_string(pair.reference) +
                        ") points outside the trajectories of " +
                        std::to_string(estimate.poses.size()) + " and " +
                        std::to_string(reference.poses.size()) + " poses");
}

std::vector<double>
pathsTo(const Trajectory& reference, const std::vector<PosePair>& pairs)
{
  std::vector<double> paths(pairs.size(), 0);
  for (std::size_t i = 1; i < pairs.size(); ++i)
    paths[i] = paths[i - 1] + (reference.poses[pairs[i].reference].translation() -
                               reference.poses[pairs[i - 1].reference].translation())
                                  .norm();
  return paths;
}

} // namespace pcl6d::benchmarking
