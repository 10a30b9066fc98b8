// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/points.h"
#include "support/room.h"

#include <pcl6d/benchmarking/icp_basin.h>

#include <vector>

namespace pcl6d::test {

/** \brief Two scans of a room, and the pose of the second in the frame of the first. */
struct RoomPair {
  Points target, source;
  Eigen::Isometry3d truth = poseFromEuler({0.4, -0.2, 0.05}, {0.02, -0.01, 0.2});
};

inline const RoomPair&
room()
{
  static const RoomPair pair = [] {
    Random random(3);
    const PillarRoom scene;
    const Eigen::Isometry3d first = planarPose(-1, 0.3, 0.1);
    RoomPair p;
    p.target = scene.scan(first, random, 0.1);
    p.source = scene.scan(first * p.truth, random, 0.1);
    return p;
  }();
  return pair;
}

/** \brief 27 starts within 0.2 m and 3 degrees. */
inline IcpBasinOptions
nearStarts()
{
  IcpBasinOptions o;
  o.offset_xy = 0.2;
  o.offset_yaw = 0.05;
  o.steps_xy = o.steps_yaw = 3;
  o.icp.max_distance = 0.5;
  o.icp.max_distance_start = 1.5;
  // Points are half a metre apart: where ICP of points comes to rest depends on its way.
  o.min_sigma_position = 0.05;
  o.min_sigma_orientation = 0.01;
  return o;
}

/** \brief Evaluates the pair, from the truth as guess. */
inline IcpBasin
evaluateRoom(const std::vector<IcpVariant>& variants, const IcpBasinOptions& options)
{
  return evaluateIcpBasin(
      room().target, room().source, room().truth, variants, options);
}

} // namespace pcl6d::test
