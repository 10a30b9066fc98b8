// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/robot_path.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Motion of a robot that scans without stopping. */
struct RobotMotionOptions {
  double speed = 1; ///< [m/s] in plan, in (0, 50]
  /** [rad/s] in (0, 10]: the robot slows down in narrower bends; at sharp corners it
   * stops and turns at this rate. Default: constant speed, and a path with sharp
   * corners is refused */
  std::optional<double> turn_rate;
  /** [m] rms displacement of the sensor by vibration, in [0, 0.1]. Each direction is a
   * sum of eight sines of equal power and random phase, one in each eighth of the
   * octaves from 1 to 10 Hz (the band passed by tyres, springs and joints of small
   * vehicles). The rotation about each axis equals that of contacts one wheel base
   * apart with the same vibration */
  double vibration = 0;
  std::uint64_t seed = 1; ///< of the phases
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Periodic uniform cubic B-spline with poses at equal time steps as control
 * points. Positions and quaternions are blended, quaternions then normalised; velocity
 * and acceleration are continuous. */
class PoseSpline {
public:
  /** \param[in] poses of one round, >= 1 \param[in] knots_per_second > 0 */
  PoseSpline(const std::vector<Eigen::Isometry3d>& poses, double knots_per_second);

  Eigen::Isometry3d
  poseAt(double time) const;

private:
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Eigen::Quaterniond> rotations_; // each on the side of the previous
                                              // quaternion
  double knots_per_second_;
};

/** \brief A drive along a path without a stop.
 *
 * Control points of a PoseSpline every 0.1 m and, with a turn rate, every 0.1 s. This
 * models a sprung mass: kinks of the floor are rounded over 0.4 m, stops and turns over
 * 0.4 s, and the steps of a stair become a wavy slope.
 * \ingroup simulation */
class RobotMotion {
public:
  /** \throws BadArgument an option is invalid, or a round takes more than a million
   * control points: 28 hours with a turn rate, 2.8 hours with vibration
   * \throws ComputeFailed no floor below the path */
  RobotMotion(const RobotPath& path,
              const RayCaster& caster,
              const RobotMotionOptions& options);

  /** \param[in] time [s] any; the drive repeats after each round
   * \return T_scene_sensor */
  Eigen::Isometry3d
  poseAt(double time) const
  {
    return spline_->poseAt(time);
  }

  /** \return [s] of one round */
  double
  duration() const
  {
    return duration_;
  }

private:
  double duration_;
  std::optional<PoseSpline> spline_;
};

} // namespace pcl6d
