// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/trajectory.h>

#include <cstdint>

namespace pcl6d {

/** \brief Errors of wheel odometry, per way driven. */
struct OdometryOptions {
  double scale_error = 0.03;       ///< systematic: share by which distances grow
  double yaw_bias = 0.004;         ///< [rad/m] systematic turn to the left
  double translation_noise = 0.01; ///< [m/sqrt(m)] standard deviation, ahead and aside
  double yaw_noise = 0.005;        ///< [rad/sqrt(m)] standard deviation
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief What a robot that believes the world to be flat makes of its way.
 *
 * Each motion between two true poses is taken in the robot's own frame, reduced to
 * (x, y, yaw), disturbed, and added up: T_{n+1} = T_n planar(dx, dy, dyaw). On a slope
 * the way along the slope counts.
 * \param[in] truth T_world_scan
 * \return one pose for each true one, with z = roll = pitch = 0; the first one is the
 * planar part of the true one \throws BadArgument see OdometryOptions::validate()
 * \ingroup scanner */
Trajectory
wheelOdometry(const Trajectory& truth,
              const OdometryOptions& options,
              std::uint64_t seed);

} // namespace pcl6d
