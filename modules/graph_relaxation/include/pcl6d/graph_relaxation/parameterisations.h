// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/twist.h>

#include <string>
#include <vector>

/** \file Parameterisations of small pose changes in GraphSLAM (book 5.2, 5.3).
 *
 * The unknown X of a pose is a motion v(p) = xb + x x (p - t) of its scan in the world axes,
 * about the pose's own position t, as Z ~ Z - M (X_a - X_b): the scans move by -X. Helix, Euler
 * and quaternion solve one system for X and differ only in the finite motion from X: they share
 * one optimum. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief How GraphSLAM describes the change of a pose. \ingroup graph_relaxation */
enum class Relaxation {
  kHelix, ///< helical motion (5.3.2): no singularity, least work; the default
  kEuler, ///< Lu and Milios with roll, pitch, yaw (5.2)
  /** quaternion with its change of scale held at zero (5.3.1) */
  kQuaternion,
  /** As published: 7 unknowns per pose, then the quaternion is normalised. For comparison only:
   * every scan may rescale, normalisation discards the scale, and the result is off the
   * optimum (3 cm at 5 cm noise, 5.3).
   * \note Source: A. Nuechter, J. Elseberg, P. Schneider, D. Paulus, CVIU 114(8), 2010. */
  kQuaternionPublished,
  /** As published: first the rotations from centred points, then the positions (5.3.3). For
   * comparison only: off the optimum on graphs with cycles (6 cm at 5 cm noise, 5.3). */
  kSmallAngle
};

/** \return helix, euler, quaternion, quaternion-published, small-angle */
std::vector<std::string>
relaxationNames();
/** \throws BadArgument an unknown name; the message lists the valid names */
Relaxation
relaxationFromName(const std::string& name);
const char*
toString(Relaxation relaxation);

/** \brief The pose moved by the helical motion of -X. Book: 5.3.2. */
Eigen::Isometry3d
moveByHelix(const Eigen::Isometry3d& pose, const Twist& X);

/** \brief The pose with roll, pitch and yaw changed by -J^-1 x; the helical motion where
 * |cos(pitch)| < 0.1 or the angles change by more than 0.5. Book: 5.2.3. */
Eigen::Isometry3d
moveByEuler(const Eigen::Isometry3d& pose, const Twist& X);

/** \brief The pose with its quaternion changed by -(0, x) q / 2, then normalised. Book: 5.3.1. */
Eigen::Isometry3d
moveByQuaternion(const Eigen::Isometry3d& pose, const Twist& X);

/** \brief moveByQuaternion() with a change of scale.
 * \param[in] X in the order xb, scale, x */
Eigen::Isometry3d
moveByScaledQuaternion(const Eigen::Isometry3d& pose,
                       const Eigen::Matrix<double, 7, 1>& X);

/** \brief Covariance of (x, y, z, roll, pitch, yaw) [m, rad] from the covariance of X.
 * \return not finite at a pitch of a right angle, where roll and yaw are not defined */
Eigen::Matrix<double, 6, 6>
eulerCovariance(const Eigen::Isometry3d& pose,
                const Eigen::Matrix<double, 6, 6>& covariance);

/** \brief Covariance of X from the covariance of (x, y, z, roll, pitch, yaw) [m, rad]: the
 * inverse of eulerCovariance(), defined at every pitch. */
Eigen::Matrix<double, 6, 6>
twistCovariance(const Eigen::Isometry3d& pose,
                const Eigen::Matrix<double, 6, 6>& covariance);

/** \brief Covariance of the twist about another point, such as the world origin, from the
 * covariance of X. */
Eigen::Matrix<double, 6, 6>
covarianceAbout(const Eigen::Vector3d& origin,
                const Eigen::Isometry3d& pose,
                const Eigen::Matrix<double, 6, 6>& covariance);

} // namespace pcl6d
