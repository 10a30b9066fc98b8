// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/room.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/deskew/motion_icp.h>
#include <pcl6d/registration/twist.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl6d::test {

/** \brief A scanner that spins in a room while it is carried along at a constant velocity, and
 * may stop to turn in place. */
struct MovingScanner {
  PillarRoom room;
  Eigen::Vector3d velocity{0.8, 0.3, 0.05};  ///< [m/s] in the world
  Eigen::Vector3d turning{0.02, -0.03, 0.4}; ///< [rad/s] in the world
  Eigen::Vector3d begin{-1, -0.5, 0.2};      ///< [m]
  double stop = INFINITY;                    ///< [s] then it stops, and turns
  double turning_after = 0;                  ///< [rad/s] then, about its z axis
  double turn = 0.1;                         ///< [s] of a scan
  double step = 0.04;                        ///< [rad] between rays
  double sigma = 0.005;                      ///< [m] of the ranges

  /** \return T_world_scanner at a time [s] */
  Eigen::Isometry3d
  poseAt(double time) const
  {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    const double moved = std::min(time, stop);
    pose.linear() = rotationFromVector(moved * turning);
    pose.translation() = begin + moved * velocity;
    if (time > stop)
      pose.rotate(
          Eigen::AngleAxisd((time - stop) * turning_after, Eigen::Vector3d::UnitZ()));
    return pose;
  }

  /** \return the poses at some times */
  Trajectory
  knots(const std::vector<double>& times) const
  {
    Trajectory knots;
    knots.stamps = times;
    for (const double time : times)
      knots.poses.push_back(poseAt(time));
    return knots;
  }

  /** \return one turn from a time on: column after column, 100 degrees upright */
  TimedPoints
  sweep(double from, Random& random) const
  {
    TimedPoints scan;
    const double phase = random.uniform(0, step), phase_up = random.uniform(0, step);
    for (double angle = phase; angle < 2 * M_PI; angle += step) {
      const double time = from + angle / (2 * M_PI) * turn;
      const Eigen::Isometry3d pose = poseAt(time);
      for (double up = -0.87 + phase_up; up < 0.87; up += step) {
        const Eigen::Vector3d ray(std::cos(up) * std::cos(angle),
                                  std::cos(up) * std::sin(angle),
                                  std::sin(up));
        const double range = room.range(pose.translation(), pose.linear() * ray);
        scan.points.push_back(((range + sigma * random.normal()) * ray).cast<float>());
        scan.times.push_back(time);
      }
    }
    return scan;
  }

  /** \return how far a pose found for a time is off, for a point 3 m away [m] */
  double
  errorOf(const Eigen::Isometry3d& pose, double time) const
  {
    const MotionSize error = distanceBetween(pose, poseAt(time));
    return error.translation + 3 * error.rotation;
  }
};

/** \return a map of the room, as scans that stand still show it */
inline SurfaceMap
roomMap(const MovingScanner& scanner, Random& random)
{
  SurfaceMap map;
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(-1, -0.5, 0.2), Eigen::Vector3d(2, 1, 0.3)}) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = place;
    std::vector<Eigen::Vector3d> world;
    for (const auto& p : scanner.room.scan(pose, random, 0.02, scanner.sigma))
      world.push_back(pose * p.cast<double>());
    map.add(world);
  }
  return map;
}

} // namespace pcl6d::test
