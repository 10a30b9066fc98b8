// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/robot_path.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How a robot drives along a path without a stop for its scans. */
struct RobotMotionOptions {
  double speed = 1; ///< [m/s] in plan, in (0, 50]
  /** [rad/s] in (0, 10]: it slows down where the path bends more, and turns so fast at sharp
   * corners, where it stops; none: it never slows down, and a path with sharp corners is
   * refused */
  std::optional<double> turn_rate;
  /** [m] rms of the distance by which the sensor shakes, in [0, 0.1]: in each direction a
   * sum of eight sines of equal power, one in each eighth of the octaves from 1 to 10 Hz
   * (what tyres, springs and joints of small vehicles pass on), of random phase; about
   * each axis as much as contacts that shake so turn it, a wheel base apart */
  double vibration = 0;
  std::uint64_t seed = 1; ///< of the phases
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Poses at equal steps of time as control points of a uniform cubic B-spline, of
 * positions and of quaternions, which are then scaled to unit length: velocity and
 * acceleration are continuous. It goes round and round. */
class PoseSpline {
public:
  /** \param[in] poses of one round, >= 1 \param[in] knots_per_second > 0 */
  PoseSpline(const std::vector<Eigen::Isometry3d>& poses, double knots_per_second);

  Eigen::Isometry3d
  poseAt(double time) const;

private:
  std::vector<Eigen::Vector3d> positions_;
  std::vector<Eigen::Quaterniond> rotations_; // each on the side of the one before
  double knots_per_second_;
};

/** \brief A drive along a path without a stop.
 *
 * Control points of a PoseSpline every 0.1 m and, with a turn rate, every 0.1 s: as a body
 * with mass on springs, kinks of the floor are rounded off over a length of 0.4 m, stops and
 * turns over 0.4 s, and the steps of a stair become a slope that waves.
 * \ingroup simulation */
class RobotMotion {
public:
  /** \throws BadArgument an option breaks its rule, or a round takes more than a million
   * control points: 28 hours with a turn rate, 2.8 hours with vibration
   * \throws ComputeFailed there is no floor below the path */
  RobotMotion(const RobotPath& path,
              const RayCaster& caster,
              const RobotMotionOptions& options);

  /** \param[in] time [s] any; the drive goes round and round
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
