// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/drift.h"
#include "support/room.h"

#include <cstddef>
#include <vector>

namespace pcl6d::test {

/** \brief A run through a room, and what of it lies on somebody who walks there. */
struct WalkedRun : DriftingRun {
  std::vector<std::vector<char>>
      walker; ///< of each point: 0 no, 1 near the floor, 2 above it
};

/** \brief Eight scans along a room in which somebody has gone on by 0.8 m before each of them.
 * \param[in] height [m] of who walks; 0: nobody is there
 * \param[in] above [m] the floor is who flies */
inline WalkedRun
makeWalkedRun(double height = 1.7, double above = 0)
{
  const bool is_walked = height > 0;
  constexpr double kSkin = 0.03, kFoot = 0.15; // [m] five deviations of a range
  WalkedRun run;
  Random random(11);
  for (int i = 0; i < 8; ++i) {
    PillarRoom room;
    const double floor = room.walls.min().z();
    const Eigen::Vector3d at(-2.5 + 0.8 * i, 0.6, floor + above);
    Eigen::AlignedBox3d body(at - Eigen::Vector3d(0.25, 0.2, 0),
                             at + Eigen::Vector3d(0.25, 0.2, height));
    if (is_walked)
      room.pillars.push_back(body);
    run.truth.push_back(
        poseFromEuler({-3 + 0.4 * i, -1.2 + 0.05 * i, 0.1}, {0, 0, 0.1 * i}));
    Eigen::Isometry3d guess = run.truth.back();
    guess.translation() += Eigen::Vector3d(0.01 * i, -0.005 * i, 0);
    run.odometry.push_back(guess);
    run.scans.push_back(room.scan(run.truth.back(), random, 0.02));
    body.extend(body.min() - Eigen::Vector3d::Constant(kSkin));
    body.extend(body.max() + Eigen::Vector3d::Constant(kSkin));
    run.walker.emplace_back();
    for (const auto& p : run.scans.back()) {
      const Eigen::Vector3d place = run.truth.back() * p.cast<double>();
      const bool is_on = is_walked && body.contains(place);
      run.walker.back().push_back(!is_on ? 0 : place.z() < floor + kFoot ? 1 : 2);
    }
  }
  return run;
}

} // namespace pcl6d::test
