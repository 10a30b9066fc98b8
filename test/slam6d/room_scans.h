// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/room.h"

#include <vector>

namespace pcl6d::test {

/** \brief Four scans of a room from places a metre apart, each turned by 60 degrees more:
 * nothing for ICP without a guess. */
struct TurnedScans {
  TurnedScans()
  {
    // Closets in two corners: the room is like itself from one side only.
    PillarRoom room;
    room.pillars.emplace_back(Eigen::Vector3d(3.5, 1, -1), Eigen::Vector3d(7, 4, 2));
    room.pillars.emplace_back(Eigen::Vector3d(-5, -4, -1),
                              Eigen::Vector3d(-3, -2.6, 2));
    Random random(3);
    for (int i = 0; i < 4; ++i) {
      truth.push_back(
          poseFromEuler({-1 + 0.9 * i, 0.4 * i - 0.5, 0}, {0, 0, i * M_PI / 3}));
      scans.push_back(room.scan(truth.back(), random, 0.03));
    }
  }
  std::vector<Points> scans;
  std::vector<Eigen::Isometry3d> truth; ///< T_world_scan
};

/** \brief Two scans of a room that end at different places. A wide gate pairs what only
 * one of them has with what only the other has. */
struct TornPair {
  TornPair()
  {
    Random random(2);
    const PillarRoom room;
    for (const auto& p : room.scan(Eigen::Isometry3d::Identity(), random))
      if (p.x() < 4)
        first.push_back(p);
    for (const auto& p : room.scan(truth, random))
      if (p.x() > -4.5f)
        second.push_back(p);
  }
  const Eigen::Isometry3d truth = poseFromEuler({2, 0, 0}, {0, 0, 0.1}); ///< of second
  Points first, second;
};

/** \return points on a smooth pipe along x, within 8 m of a scanner at x [m] */
inline Points
smoothPipe(Random& random, double x)
{
  const Eigen::Vector3d scanner(x, 0.3, -0.2);
  Points points;
  for (int i = 0; i < 6000; ++i) {
    const double turn = random.uniform(-M_PI, M_PI), r = 1.5 + 0.002 * random.normal();
    const Eigen::Vector3d p(
        random.uniform(x - 8, x + 8), r * std::cos(turn), r * std::sin(turn));
    points.push_back((p - scanner).cast<float>());
  }
  return points;
}

/** \return the same on two parallel walls */
inline Points
parallelWalls(Random& random, double x)
{
  const Eigen::Vector3d scanner(x, 0.3, -0.2);
  Points points;
  for (int i = 0; i < 6000; ++i) {
    const double y = (i % 2 == 0 ? 1.5 : -1.5) + 0.002 * random.normal();
    const Eigen::Vector3d p(random.uniform(x - 8, x + 8), y, random.uniform(-1.5, 1.5));
    points.push_back((p - scanner).cast<float>());
  }
  return points;
}

/** \return a heap of points that is no room */
inline Points
heap(Random& random)
{
  Points points;
  for (int i = 0; i < 6000; ++i)
    points.emplace_back(static_cast<float>(3 * random.normal()),
                        static_cast<float>(3 * random.normal()),
                        static_cast<float>(random.normal()));
  return points;
}

inline const TurnedScans&
turned()
{
  static const TurnedScans scans;
  return scans;
}

} // namespace pcl6d::test
