// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/drift.h"
#include "support/room.h"

#include <cmath>
#include <cstddef>

namespace pcl6d::test {

inline Eigen::Isometry3d
movedBy(double x)
{
  return poseFromEuler({x, 0, 0}, {});
}

/** \return a corridor of 44 x 3 m with closets, no two parts of which are alike */
inline PillarRoom
corridorWithClosets(Random& random)
{
  PillarRoom corridor;
  corridor.walls = {Eigen::Vector3d(-12, -1.5, -1), Eigen::Vector3d(32, 1.5, 1.5)};
  corridor.pillars.clear();
  for (double x = -11; x < 31; x += random.uniform(0.7, 2.5)) {
    const double side = random.uniform() < 0.5 ? -1 : 1;
    const double depth = random.uniform(0.2, 0.6), length = random.uniform(0.3, 1.2);
    const double y = side * (1.5 - 0.5 * depth);
    corridor.pillars.emplace_back(
        Eigen::Vector3d(x, y - 0.5 * depth, -1),
        Eigen::Vector3d(x + length, y + 0.5 * depth, random.uniform(-0.5, 1.5)));
  }
  return corridor;
}

/** \return a room that has nothing to do with the corridor */
inline PillarRoom
roomOfElsewhere()
{
  PillarRoom room;
  room.walls = {Eigen::Vector3d(-4, -3, -1), Eigen::Vector3d(3.5, 5, 1.4)};
  return room;
}

/** \return what is seen up to 7 m from a pose in a room */
inline Points
shortSighted(const PillarRoom& room, const Eigen::Isometry3d& pose, Random& random)
{
  Points near;
  for (const auto& p : room.scan(pose, random, 0.03))
    if (p.norm() < 7)
      near.push_back(p);
  return near;
}

/** \return the pose of a scanner at x [m] of the corridor, swaying a little */
inline Eigen::Isometry3d
poseInCorridor(double x)
{
  return poseFromEuler({x, 0.2 * std::sin(x), 0}, {0, 0, 0.1 * std::cos(x)});
}

/** \return a drive of 1 m per scan along the corridor, seen up to 7 m; from a scan on the
 * odometry is farther by a jump [m] */
inline DriftingRun
makeCorridorRun(std::size_t count, std::size_t jumps_at, double jump)
{
  Random random(5);
  const PillarRoom corridor = corridorWithClosets(random);
  DriftingRun run;
  for (std::size_t i = 0; i < count; ++i) {
    run.truth.push_back(poseInCorridor(static_cast<double>(i)));
    run.odometry.push_back(movedBy(i >= jumps_at ? jump : 0) * run.truth.back());
    run.scans.push_back(shortSighted(corridor, run.truth.back(), random));
  }
  return run;
}

} // namespace pcl6d::test
