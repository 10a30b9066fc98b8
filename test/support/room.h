// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/poses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pcl6d::test {

/** \return points on the floor and two walls that meet in the origin, each a square of
 * the given side [m], with normal noise sigma [m] along the normal of the surface */
inline Points
roomCorner(Random& random, std::size_t count, double side, double sigma = 0)
{
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d p(random.uniform(0, side), random.uniform(0, side), 0);
    p.z() = sigma * random.normal();
    const int turns = static_cast<int>(i % 3);
    points.push_back(Eigen::Vector3d(p[turns], p[(turns + 1) % 3], p[(turns + 2) % 3])
                         .cast<float>());
  }
  return points;
}

/** \brief A closed room with box-shaped pillars, seen from inside. */
struct PillarRoom {
  Eigen::AlignedBox3d walls{Eigen::Vector3d(-5, -4, -1), Eigen::Vector3d(7, 4, 2)};
  std::vector<Eigen::AlignedBox3d> pillars{
      {Eigen::Vector3d(-3, 1.5, -1), Eigen::Vector3d(-2.4, 2.3, 2)},
      {Eigen::Vector3d(1, -3, -1), Eigen::Vector3d(1.5, -2, 0.7)},
      {Eigen::Vector3d(4.5, 2, -1), Eigen::Vector3d(5.5, 2.6, 2)},
      {Eigen::Vector3d(3, -1.5, -1), Eigen::Vector3d(3.7, -0.9, 0.2)},
      {Eigen::Vector3d(-4, -2.5, 0.5), Eigen::Vector3d(-3, -1, 1)}};

  /** \return the range [m] along a ray from inside the room, outside the pillars */
  double
  range(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const
  {
    double nearest = crossing(walls, origin, direction).second;
    for (const auto& pillar : pillars) {
      const auto [in, out] = crossing(pillar, origin, direction);
      if (in > 0 && in < out)
        nearest = std::min(nearest, in);
    }
    return nearest;
  }

  /** \return a scan from a pose, in its own frame: a full turn, 100 degrees upright.
   * Rays stand on a grid whose phase is drawn for each scan, so that
   * two scans never meet the same points */
  Points
  scan(const Eigen::Isometry3d& T_world_scan,
       Random& random,
       double step = 0.05,
       double sigma = 0.005) const
  {
    Points points;
    const double phase_up = random.uniform(0, step), phase = random.uniform(0, step);
    for (double up = -0.87 + phase_up; up < 0.87; up += step)
      for (double turn = phase; turn < 2 * M_PI; turn += step) {
        const Eigen::Vector3d ray(
            std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up));
        const double r = range(T_world_scan.translation(), T_world_scan.linear() * ray);
        points.push_back(((r + sigma * random.normal()) * ray).cast<float>());
      }
    return points;
  }

private:
  /** \return where a ray enters and leaves a box (slabs of Kay and Kajiya 1986) */
  static std::pair<double, double>
  crossing(const Eigen::AlignedBox3d& box,
           const Eigen::Vector3d& origin,
           const Eigen::Vector3d& direction)
  {
    double in = -std::numeric_limits<double>::infinity();
    double out = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (box.min()[axis] - origin[axis]) / direction[axis];
      const double b = (box.max()[axis] - origin[axis]) / direction[axis];
      in = std::max(in, std::min(a, b));
      out = std::min(out, std::max(a, b));
    }
    return {in, out};
  }
};

} // namespace pcl6d::test
