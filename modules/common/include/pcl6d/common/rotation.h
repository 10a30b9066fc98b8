// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

/** \file Representations of rotations and conversions between them (book, Appendix A.1). One
 * Euler convention everywhere: R = Rz(yaw) Ry(pitch) Rx(roll), as in pcl::getTransformation.
 * Angles are in radians, frames right-handed. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Roll, pitch and yaw [rad] of R = Rz(yaw) Ry(pitch) Rx(roll). A positive pitch
 * turns the forward axis downwards. \ingroup common */
struct EulerAngles {
  double roll = 0;
  double pitch = 0;
  double yaw = 0;
};

/** \return the rotation Rz(yaw) Ry(pitch) Rx(roll) */
Eigen::Matrix3d
rotationFromEuler(const EulerAngles& angles);

/** \brief Inverse of rotationFromEuler(), accurate near the poles and finite
 * everywhere. \return roll and yaw in (-pi, pi], pitch in [-pi/2, pi/2]; in gimbal lock
 * yaw is 0 */
EulerAngles
eulerFromRotation(const Eigen::Matrix3d& R);

/** \return [v]x, the matrix with skew(v) w = v x w */
Eigen::Matrix3d
skew(const Eigen::Vector3d& v);

/** \brief Rotation by |w| [rad] about w (Rodrigues' formula). */
Eigen::Matrix3d
rotationFromVector(const Eigen::Vector3d& w);

/** \brief Inverse of rotationFromVector(). Uses the quaternion, accurate for small angles and
 * near pi. \return axis times angle [rad], |w| in [0, pi]; at pi the sign of the axis is free */
Eigen::Vector3d
rotationVector(const Eigen::Matrix3d& R);

/** \return the angle of R [rad], in [0, pi] */
double
rotationAngle(const Eigen::Matrix3d& R);

/** \brief Constant-speed rotation from R0 (s = 0) to R1 (s = 1) on the shorter way;
 * equals exp(s log(R1 R0^T)) R0. \param[in] s any real number */
Eigen::Matrix3d
slerp(const Eigen::Matrix3d& R0, const Eigen::Matrix3d& R1, double s);

/** \brief The rotation closest to A in the Frobenius norm, by SVD.
 * \return a proper rotation also for mirrored or singular A */
Eigen::Matrix3d
nearestRotation(const Eigen::Matrix3d& A);

/** \return the rotation by the smallest angle that turns the direction `from` into the direction
 * `to`; about any perpendicular axis if the directions are opposite. Lengths do not matter, but
 * must not be zero. */
Eigen::Quaterniond
shortestRotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/** \return q or -q, with w >= 0; both describe one rotation */
Eigen::Quaterniond
canonical(const Eigen::Quaterniond& q);

/** \return the angle wrapped to (-pi, pi] */
double
wrapAngle(double angle);

} // namespace pcl6d
