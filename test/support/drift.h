// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/room.h"

#include <vector>

namespace pcl6d::test {

/** \brief Scans of a room from a known path, with odometry that drifts in all six
 * degrees of freedom. */
struct DriftingRun {
  std::vector<Eigen::Isometry3d> truth;    ///< T_world_scan
  std::vector<Eigen::Isometry3d> odometry; ///< starts at the truth, then drifts
  std::vector<Points> scans;
};

/** \return a run through a room, up and down and rolling a little on the way
 * \param[in] count of scans \param[in] start pose of the first, over the room's own */
inline DriftingRun
makeDriftingRun(std::size_t count,
                const PillarRoom& room = {},
                const Eigen::Isometry3d& start = Eigen::Isometry3d::Identity())
{
  Random random(1);
  DriftingRun run;
  const Eigen::Isometry3d drift =
      poseFromEuler({0.05, -0.03, 0.03}, {0.01, -0.01, 0.02});
  for (std::size_t i = 0; i < count; ++i) {
    const double s = static_cast<double>(i);
    const Eigen::Isometry3d in_room =
        poseFromEuler({-1 + 0.3 * s, 0.5 * std::sin(0.5 * s), 0.1 * std::sin(s)},
                      {0.05 * std::sin(0.7 * s), 0.05 * std::cos(0.9 * s), 0.15 * s});
    run.scans.push_back(room.scan(in_room, random));
    run.truth.push_back(start * in_room);
    if (i == 0)
      run.odometry.push_back(run.truth[0]);
    else
      run.odometry.push_back(run.odometry[i - 1] * run.truth[i - 1].inverse() *
                             run.truth[i] * drift);
  }
  return run;
}

} // namespace pcl6d::test
