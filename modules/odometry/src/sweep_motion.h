// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/registration/twist.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl6d::odometry {

/** \brief A point of a sweep with its time. */
struct SweepPoint {
  Eigen::Vector3f point = Eigen::Vector3f::Zero(); ///< [m] in the sensor's frame
                                                   ///< at its own time
  float share = 0; ///< of the time of the sweep: 0 at the begin, 1 at the end
};
using SweepPoints = std::vector<SweepPoint>;

/** Parts of a sweep within which the velocity is constant, where it changes suddenly. */
inline constexpr std::size_t kSweepParts = 8;

/** \brief The motion of a scanner within a sweep: a linear change of velocity, and, where this does
 * not describe the motion, offsets from it between the parts of the sweep. */
struct SweepMotion {
  Eigen::Isometry3d begin =
      Eigen::Isometry3d::Identity(); ///< T_world_sensor at share 0
  Twist velocity = Twist::Zero();    ///< from begin to end, in the frame of the begin
  /** difference of the velocity from the sweep before: half of the change falls
   * within this sweep */
  Twist change = Twist::Zero();
  /** twists in addition, at the begin of each part and at the end, in between linear; empty: none */
  std::vector<Twist> offsets;

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
    const Twist even = share * velocity - 0.5 * share * (1 - share) * change;
    return offsets.empty() ? even : Twist(even + offsetAt(share));
  }

  /** \return the place of a point [m, world] */
  Eigen::Vector3d
  place(const SweepPoint& measured) const;

private:
  Twist
  offsetAt(double share) const;
};

/** \brief A share of the time of a sweep as a part and a share of the part. */
struct SweepPart {
  std::size_t part = 0;
  double share = 0;

  SweepPart(double share_of_sweep, std::size_t num_parts)
  {
    const double place = share_of_sweep * static_cast<double>(num_parts);
    if (place > 0) // a stamp may lie before the sweep
      part = std::min(static_cast<std::size_t>(place), num_parts - 1);
    share = place - static_cast<double>(part);
  }
};

/** \return the same motion with the time running backward: neglects products of the velocity and
 * its change */
SweepMotion
reversed(const SweepMotion& motion);

/** \return the positions of the points [m, world] */
std::vector<Eigen::Vector3d>
placesOf(const SweepPoints& points,
         const SweepMotion& motion,
         unsigned int num_threads);

/** \return the covariance of two motions about the point `to`, from that about `from` */
Eigen::Matrix<double, 12, 12>
movedCovariance(const Eigen::Matrix<double, 12, 12>& covariance,
                const Eigen::Vector3d& from,
                const Eigen::Vector3d& to);

} // namespace pcl6d::odometry
