// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/twist.h>

#include <Eigen/Geometry>

#include <vector>

namespace pcl6d::odometry {

/** \brief A point of a sweep with its time. */
struct SweepPoint {
  Eigen::Vector3f point = Eigen::Vector3f::Zero(); ///< [m] in the sensor's frame
                                                   ///< at its own time
  float share = 0; ///< of the time of the sweep: 0 at the begin, 1 at the end
};
using SweepPoints = std::vector<SweepPoint>;

/** \brief The motion of a scanner within a sweep: a linear change of velocity. */
struct SweepMotion {
  Eigen::Isometry3d begin =
      Eigen::Isometry3d::Identity(); ///< T_world_sensor at share 0
  Twist velocity = Twist::Zero();    ///< from begin to end, in the frame of the begin
  /** difference of the velocity from the sweep before: half of the change falls
   * within this sweep */
  Twist change = Twist::Zero();

  /** \return T_world_sensor at share 1 */
  Eigen::Isometry3d
  end() const
  {
    return begin * motionFromTwist(velocity);
  }

  /** \return the twist from the begin to a share of the time */
  Twist
  twistAt(double share) const
  {
    return share * velocity - 0.5 * share * (1 - share) * change;
  }

  /** \return the place of a point [m, world] */
  Eigen::Vector3d
  place(const SweepPoint& measured) const;
};

/** \return the positions of the points [m, world] */
std::vector<Eigen::Vector3d>
placesOf(const SweepPoints& points,
         const SweepMotion& motion,
         unsigned int num_threads);

/** \return the information of a motion about the point `to`, from the information about `from` */
Eigen::Matrix<double, 6, 6>
movedInformation(const Eigen::Matrix<double, 6, 6>& information,
                 const Eigen::Vector3d& from,
                 const Eigen::Vector3d& to);

} // namespace pcl6d::odometry
