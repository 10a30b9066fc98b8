// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/triangle_scene.h>

#include <Eigen/Geometry>

#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What a moving body does at the end of its way. */
enum class WayEnd {
  kStop,   ///< stays there
  kReturn, ///< turns on the spot and goes back, for ever
  kClosed  ///< goes straight on to the first corner, for ever
};

/** \brief A thing that moves through a scene while it is scanned: a person, a car.
 *
 * It follows straight legs between corners, upright, its x axis ahead in plan, and turns
 * at once where a leg ends: with constant speed for ever, or by a timetable.
 * \ingroup simulation */
struct MovingBody {
  std::string name = "body";
  /// in the body's own frame: x ahead, z up, origin where it touches the ground
  TriangleScene shape;
  std::vector<Eigen::Vector3d> way; ///< [m] corners in the scene, >= 2 apart in plan
  double speed = 1;                 ///< [m/s] along the way, in [0, 1000]
  double start = 0;                 ///< [m] along the way at time 0, >= 0
  WayEnd end = WayEnd::kReturn;
  /** [s] when it is at each corner, not decreasing: then `speed`, `start` and `end` do not
   * count, it waits where two neighbours are one place, jumps where they have one time,
   * and stands still before the first and after the last one. Empty: constant speed */
  std::vector<double> times;
  bool follows_slope = false; ///< its x axis rises and falls with the leg, as a car's

  /** \throws BadArgument naming the body and what breaks its rule */
  void
  validate() const;

  /** \param[in] time [s] of the simulation, >= 0
   * \return T_scene_body. The body must be valid */
  Eigen::Isometry3d
  poseAt(double time) const;

  /** \return whether it is ever at another place than at the start */
  bool
  moves() const;

private:
  Eigen::Isometry3d
  poseByTimetable(double time) const;
  Eigen::Isometry3d
  poseOn(const Eigen::Vector3d& place, const Eigen::Vector3d& leg) const;
};

} // namespace pcl6d
