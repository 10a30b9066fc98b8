// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/rotation.h>

/** \file
 * Poses: `Eigen::Isometry3d T_world_scan` maps a scan's points [m] into the world. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief The pose of a robot in the plane: heading yaw [rad], position (x, y) [m]. */
Eigen::Isometry3d
planarPose(double x, double y, double yaw);

/** \return the pose with position t [m] and R = Rz(yaw) Ry(pitch) Rx(roll) */
Eigen::Isometry3d
poseFromEuler(const Eigen::Vector3d& t, const EulerAngles& angles);

/** \brief Carries the odometry's motion over to a corrected pose (book, 5.1.1):
 * T_{n+1} = T_n O_n^-1 O_{n+1}. All six degrees of freedom are kept; planar odometry
 * continues the slope of T_n.
 * \param[in] corrected T_n, the registered pose of scan n
 * \param[in] odometry_from, odometry_to O_n and O_{n+1}
 * \return the predicted pose of scan n + 1, with an exactly rigid rotation */
Eigen::Isometry3d
extrapolateOdometry(const Eigen::Isometry3d& corrected,
                    const Eigen::Isometry3d& odometry_from,
                    const Eigen::Isometry3d& odometry_to);

/** \brief The size of a motion. */
struct MotionSize {
  double translation = 0; ///< [m]
  double rotation = 0;    ///< [rad], in [0, pi]
};

/** \return length and angle of the error pose a^-1 b */
MotionSize
distanceBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);

/** \return whether all entries are finite and R^T R = I, det R = 1 within tolerance
 * \param[in] tolerance largest entry of |R^T R - I|; 1e-3 accepts rows with 4 digits */
bool
isRigid(const Eigen::Isometry3d& pose, double tolerance = 1e-3);

/** \return the pose with its rotation replaced by the rotation of the normalised quaternion.
 * Repeated products collect rounding errors; call this after each product of a long sequence.
 * \param[in] pose rigid, up to rounding */
Eigen::Isometry3d
exactlyRigid(const Eigen::Isometry3d& pose);

/** \brief The whole metres to subtract from all poses of a run to keep the digits of float
 * points: the rounded first position if farther than 10 km from the origin, else zero. */
Eigen::Vector3d
worldOffset(const Eigen::Isometry3d& first_pose);

} // namespace pcl6d
