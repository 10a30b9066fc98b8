// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/triangle_scene.h>

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Behaviour of a moving body at the end of its way. */
enum class WayEnd {
  kStop,   ///< stays there
  kReturn, ///< turns on the spot and goes back, for ever
  kClosed  ///< goes straight on to the first corner, for ever
};

/** \brief A body that moves through a scene during the scans: a person, a car.
 *
 * It follows straight legs between corners, upright, its x axis ahead in plan, and
 * turns instantly at corners. The speed is constant, without end, or given by a
 * timetable.
 * \ingroup simulation */
struct MovingBody {
  std::string name = "body";
  /// in the body's own frame: x ahead, z up, origin at the contact with the ground
  TriangleScene shape;
  std::vector<Eigen::Vector3d> way; ///< [m] corners in the scene, >= 2 apart in plan
  double speed = 1;                 ///< [m/s] along the way, in [0, 1000]
  double start = 0;                 ///< [m] along the way at time 0, >= 0
  WayEnd end = WayEnd::kReturn;
  /** [s] time at each corner, not decreasing; replaces `speed`, `start` and `end`. The
   * body waits between equal corners, jumps between corners of equal time, and stands
   * still before the first and after the last time. Empty: constant speed */
  std::vector<double> times;
  bool follows_slope = false; ///< its x axis rises and falls with the leg, like a car's

  /** \throws BadArgument naming the body and the broken rule */
  void
  validate() const;

  /** \param[in] time [s] of the simulation, >= 0
   * \return T_scene_body. The body must be valid */
  Eigen::Isometry3d
  poseAt(double time) const;

  /** \return whether the body ever leaves its first pose */
  bool
  moves() const;

private:
  Eigen::Isometry3d
  poseByTimetable(double time) const;
  Eigen::Isometry3d
  poseOn(const Eigen::Vector3d& place, const Eigen::Vector3d& leg) const;
};

} // namespace pcl6d
