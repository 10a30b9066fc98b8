// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The motion within a tracked sweep. */
struct SweepEnds {
  Eigen::Isometry3d T_world_begin =
      Eigen::Isometry3d::Identity();                             ///< at the first time
  Eigen::Isometry3d T_world_end = Eigen::Isometry3d::Identity(); ///< at the last time
  double begin = 0, end = 0; ///< [s] since the stamp: first and last time
  double stamp = 0;          ///< [s]
  bool follows = false;      ///< the sweep before was matched with the same map
};

/** \brief Uncertainty of the frames of sweeps against their own points, from the tracked motion.
 *
 * Points of a sweep fix its middle. The pose at the stamp follows by the motion within, and no match
 * of the points shows an error of it. Two facts do: a sweep must begin where the sweep before ended,
 * and vehicles do not alternate. A velocity that is wrong by 2 e puts the ends off by e. Where such
 * errors are independent from sweep to sweep, the squared jump between two sweeps is 2 e^2; an error
 * that alternates shows no jump, but a second difference of the velocities of 8 e. A sudden change
 * of velocity D has a second difference of D, and its sagitta, not described by the motion, is D / 8;
 * twice as much at the begin of a map, which no sweep before holds.
 * Jumps are averaged over the five sweeps before and behind, since a distorted map makes all alike;
 * of the second differences, the largest of the sweep and its neighbours counts.
 * \return for each sweep the covariance of its frame, for small motions (translation [m], rotation
 * [rad]) in its own axes; zero where sweeps have no duration \ingroup odometry */
std::vector<Eigen::Matrix<double, 6, 6>>
frameCovariances(const std::vector<SweepEnds>& sweeps);

} // namespace pcl6d
