// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/trajectory.h>

#include <cstdint>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Errors of wheel odometry, per distance driven. Systematic errors come from
 * unequal wheels (yaw_bias) and an uncertain wheel base (turn_scale_error).
 * \note Source: J. Borenstein, L. Feng, "Measurement and correction of systematic
 * odometry errors in mobile robots", IEEE Trans. Robotics and Automation 12(6),
 * 1996. */
struct OdometryOptions {
  double scale_error = 0.03;       ///< systematic: share by which distances grow
  double yaw_bias = 0.004;         ///< [rad/m] systematic turn to the left
  double translation_noise = 0.01; ///< [m/sqrt(m)] standard deviation, ahead and aside
  double yaw_noise = 0.005;        ///< [rad/sqrt(m)] standard deviation
  /// systematic: share by which turns grow, from a wrong distance between the wheels
  double turn_scale_error = 0;
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Simulates planar wheel odometry.
 *
 * Each motion between two true poses is taken in the robot's own frame, reduced to (x,
 * y, yaw), disturbed, and added up: T_{n+1} = T_n planar(dx, dy, dyaw). On a slope the
 * distance along the slope counts.
 * \param[in] truth T_world_scan
 * \return one pose per true pose, with z = roll = pitch = 0; the first pose is the
 * planar part of the true pose \throws BadArgument see OdometryOptions::validate()
 * \ingroup simulation */
Trajectory
wheelOdometry(const Trajectory& truth,
              const OdometryOptions& options,
              std::uint64_t seed);

/** \brief Errors of visual-inertial odometry. Four of the six degrees of freedom drift;
 * roll and pitch are bounded by gravity. */
struct VisualInertialOptions {
  double scale_error = 0.005;       ///< systematic: share by which distances grow
  double translation_noise = 0.005; ///< [m/sqrt(m)] standard deviation, each axis
  double yaw_bias = 0.0003;         ///< [rad/m] systematic turn to the left
  double yaw_noise = 0.001;         ///< [rad/sqrt(m)] standard deviation
  double tilt_noise = 0.003;        ///< [rad] standard deviation of roll and of pitch
  double tilt_way = 5;              ///< [m] correlation length of tilt errors, > 0
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Simulates visual-inertial odometry with six degrees of freedom.
 *
 * The heading drifts as a random walk. Errors of roll and pitch follow a first-order
 * Gauss-Markov process that starts at zero, so they stay bounded. The position adds up
 * the true steps, scaled, disturbed and turned by the estimated rotation.
 * \param[in] truth T_world_scan, z up
 * \return one pose per true pose; the first pose is true
 * \throws BadArgument see VisualInertialOptions::validate() \ingroup simulation */
Trajectory
visualInertialOdometry(const Trajectory& truth,
                       const VisualInertialOptions& options,
                       std::uint64_t seed);

} // namespace pcl6d
