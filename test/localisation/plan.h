// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/random.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/localisation/monte_carlo_localisation.h>

#include <cmath>
#include <vector>

/** \file A made-up plan, a way through it, and what a 2D scanner sees there. */
namespace pcl6d::test {

/** Appends the four walls of a building. */
inline void
addBuilding(Segments& walls, double x, double y, double width, double depth, double yaw)
{
  const SinCos turn = portableSinCos(yaw);
  const auto corner = [&](double u, double v) {
    return Eigen::Vector2d(x + turn.cos * u - turn.sin * v,
                           y + turn.sin * u + turn.cos * v);
  };
  const Eigen::Vector2d corners[] = {
      corner(0, 0), corner(width, 0), corner(width, depth), corner(0, depth)};
  for (int i = 0; i < 4; ++i)
    walls.push_back({corners[i], corners[(i + 1) % 4]});
}

/** Buildings of several sizes and directions around a street of 100 m. */
inline Segments
street()
{
  Segments walls;
  addBuilding(walls, -10, 8, 22, 12, 0.05);
  addBuilding(walls, 20, 10, 15, 9, -0.2);
  addBuilding(walls, 45, 7, 30, 14, 0.0);
  addBuilding(walls, 84, 9, 25, 10, 0.3);
  addBuilding(walls, -8, -20, 18, 11, 0.1);
  addBuilding(walls, 18, -18, 24, 10, -0.05);
  addBuilding(walls, 52, -22, 12, 12, 0.4);
  addBuilding(walls, 75, -19, 30, 9, 0.0);
  addBuilding(walls, 118, -12, 8, 20, 0.1);
  return walls;
}

/** \return how far a ray goes before it meets a wall, by Cramer's rule; infinity if none */
inline double
rangeOf(const Segments& walls, const Eigen::Vector2d& from, double angle)
{
  const SinCos direction = portableSinCos(angle);
  const Eigen::Vector2d d(direction.cos, direction.sin);
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& wall : walls) {
    const Eigen::Vector2d e = wall.b - wall.a, f = wall.a - from;
    const double det = e.x() * d.y() - e.y() * d.x();
    const double t = (e.x() * f.y() - e.y() * f.x()) / det;
    const double s = (d.x() * f.y() - d.y() * f.x()) / det;
    if (std::isfinite(t) && t > 0 && s >= 0 && s <= 1)
      nearest = std::min(nearest, t);
  }
  return nearest;
}

/** \return what a 2D scanner with 100 beams sees, each with 5 cm of noise, up to 50 m */
inline VirtualScan
scanOf(const Segments& walls, const Eigen::Vector3d& pose, Random& random)
{
  constexpr int kBeams = 100;
  VirtualScan scan;
  for (int i = 0; i < kBeams; ++i) {
    const double angle = 2 * M_PI * i / kBeams;
    const double range =
        rangeOf(walls, pose.head<2>(), pose.z() + angle) + 0.05 * random.normal();
    const SinCos beam = portableSinCos(angle);
    if (range < 50)
      scan.points.emplace_back(range * beam.cos, range * beam.sin);
  }
  scan.walls = scan.points.size();
  return scan;
}

/** A way, and the motions between its poses as a drifting odometry sees them. */
struct Drive {
  std::vector<Eigen::Vector3d> poses;
  std::vector<Eigen::Vector3d> motions; ///< zero for the first
  double odometry_error = 0;            ///< [m] largest of the odometry alone
};

/** \return the motion from a to b in the frame of a */
inline Eigen::Vector3d
motionBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  const SinCos turn = portableSinCos(a.z());
  const Eigen::Vector2d way = (b - a).head<2>();
  return {turn.cos * way.x() + turn.sin * way.y(),
          -turn.sin * way.x() + turn.cos * way.y(),
          wrapAngle(b.z() - a.z())};
}

/** \return a after a motion in its frame */
inline Eigen::Vector3d
moved(const Eigen::Vector3d& a, const Eigen::Vector3d& motion)
{
  const SinCos turn = portableSinCos(a.z());
  return {a.x() + turn.cos * motion.x() - turn.sin * motion.y(),
          a.y() + turn.sin * motion.x() + turn.cos * motion.y(),
          wrapAngle(a.z() + motion.z())};
}

/** A winding way of 100 m along the street in steps of 1 m. The odometry is 3 % long and
 * turns by 0.2 deg per metre too much. */
inline Drive
driveAlongTheStreet()
{
  Drive drive;
  Eigen::Vector3d odometry(0, 0, 0);
  for (int i = 0; i <= 100; ++i) {
    const SinCos wave = portableSinCos(0.12 * i);
    drive.poses.emplace_back(i, 2 * wave.sin, portableAtan2(0.24 * wave.cos, 1));
    Eigen::Vector3d motion(0, 0, 0);
    if (i > 0) {
      motion = motionBetween(drive.poses[drive.poses.size() - 2], drive.poses.back());
      motion.head<2>() *= 1.03;
      motion.z() += 0.2 * M_PI / 180;
    }
    odometry = i == 0 ? drive.poses.front() : moved(odometry, motion);
    drive.motions.push_back(motion);
    drive.odometry_error = std::max(drive.odometry_error,
                                    (odometry - drive.poses.back()).head<2>().norm());
  }
  return drive;
}

} // namespace pcl6d::test
