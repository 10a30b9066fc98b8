// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/robot_path.h>

#include <Eigen/Geometry>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A drive along a path without a stop, with constant speed in plan.
 *
 * The poses of the path every 0.1 m are the control points of a uniform cubic B-spline,
 * of positions and of quaternions, which are then scaled to unit length. So velocity and
 * acceleration are continuous, as those of a body with mass on springs: kinks of the
 * floor are rounded off over a length of 0.4 m, and the steps of a stair become a slope
 * that waves. \ingroup simulation */
class RobotMotion {
public:
  /** \param[in] speed [m/s] in plan, in (0, 50]
   * \throws BadArgument speed breaks its rule \throws ComputeFailed there is no floor
   * below the path */
  RobotMotion(const RobotPath& path, const RayCaster& caster, double speed);

  /** \param[in] time [s] any; the drive goes round and round
   * \return T_scene_sensor */
  Eigen::Isometry3d
  poseAt(double time) const;

private:
  std::vector<Eigen::Vector3d> positions_;    // control points of one round
  std::vector<Eigen::Quaterniond> rotations_; // each on the side of the one before
  double knots_per_second_;
};

} // namespace pcl6d
