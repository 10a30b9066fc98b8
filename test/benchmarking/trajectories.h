// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/poses.h"

#include <pcl6d/benchmarking/pose_matching.h>

#include <limits>

namespace pcl6d::test {

// Products of a few rotations and sums of coordinates up to 100 m, in double.
inline constexpr double kAngleTol =
    200 * std::numeric_limits<double>::epsilon();       // [rad]
inline constexpr double kPositionTol = kAngleTol * 100; // [m]

/** \return poses one metre apart along x */
inline Trajectory
straightDrive(std::size_t count)
{
  Trajectory trajectory;
  for (std::size_t i = 0; i < count; ++i)
    trajectory.poses.push_back(planarPose(static_cast<double>(i), 0, 0));
  return trajectory;
}

inline Trajectory
moved(const Eigen::Isometry3d& motion, Trajectory trajectory)
{
  for (auto& pose : trajectory.poses)
    pose = motion * pose;
  return trajectory;
}

/** \return every pose with itself */
inline std::vector<PosePair>
allPairs(std::size_t count)
{
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < count; ++i)
    pairs.push_back({i, i});
  return pairs;
}

} // namespace pcl6d::test
