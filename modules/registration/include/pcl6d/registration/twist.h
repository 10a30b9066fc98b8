// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/rotation.h>

/** \file
 * Infinitesimal motions, and their conversion to finite motions (book 4.1.2, 4.1.3). */
namespace PCL6D_EXPORTS pcl6d {

/** \brief An infinitesimal motion v(p) = xb + x x p: velocity xb of the origin [m], then
 * rotation x [rad], in the order of Lu and Milios. */
using Twist = Eigen::Matrix<double, 6, 1>;

/** \brief The helical motion of a twist: a turn by |x| about its axis with an advance along the
 * axis; the matrix exponential.
 *
 * Accurate for every angle: by a series in |x|, the computation avoids the foot point of the axis,
 * which runs to infinity when |x| goes to zero. \note Source: M. Hofer, H. Pottmann, "Orientierung
 * von Laserscanner-Punktwolken", VGI 91(4), 2003, with the angle |x|. Book: 4.1.2. */
Eigen::Isometry3d
motionFromTwist(const Twist& twist);

/** \brief Inverse of motionFromTwist(): the matrix logarithm. \return the twist, its rotation
 * within [0, pi] */
Twist
twistFromMotion(const Eigen::Isometry3d& motion);

/** \brief J of the book's H = [I, [t]x J; 0, J]: maps the rates of (roll, pitch, yaw) to
 * the angular velocity in the world. det J = cos(pitch). Book: 4.1.3. */
Eigen::Matrix3d
eulerRates(const EulerAngles& angles);

} // namespace pcl6d
