// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/graph_relaxation/link_error.h>

/** \file The error of a link, fast. */
namespace pcl6d::graph_relaxation {

/** \brief A pose as quaternion and translation, which stays rigid under many steps. */
struct QuaternionPose {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();

  QuaternionPose() = default;
  explicit QuaternionPose(const Eigen::Isometry3d& T)
  : q(Eigen::Quaterniond(T.linear()).normalized()), t(T.translation())
  {}
  Eigen::Isometry3d
  isometry() const;

  /** \return the pose after a small motion (dt, dr) in its own axes; the turn is 2
   * atan(|dr|/2), without trigonometric functions */
  QuaternionPose
  moved(const Vector6& motion) const;
};

/** \brief A measurement, prepared. */
struct LinkMeasurement {
  explicit LinkMeasurement(const PoseLink& link);

  QuaternionPose T_from_to;
  Matrix6 information;
};

/** \brief The second-order model of a link's share of the cost, e^T information e / 2.
 */
struct LinkTerms {
  Matrix6 H_from;    ///< J_from^T information J_from
  Matrix6 H_to;      ///< J_to^T information J_to
  Matrix6 H_from_to; ///< J_from^T information J_to
  Vector6 g_from;    ///< J_from^T information e
  Vector6 g_to;      ///< J_to^T information e
};

Vector6
errorOf(const LinkMeasurement& link, const QuaternionPose& a, const QuaternionPose& b);

/** \brief Error and derivative by b, and the adjoint for the derivative by a: J_from = -J_to
 * Ad(X^-1) with X = T_a^-1 T_b. */
struct LinkGeometry {
  LinkGeometry(const LinkMeasurement& link,
               const QuaternionPose& a,
               const QuaternionPose& b);

  Vector6 error;
  Eigen::Matrix3d J_translation; ///< upper left block of J_to
  Eigen::Matrix3d J_rotation;    ///< lower right block; the remaining blocks are zero
  Eigen::Matrix3d R;             ///< of X
  Eigen::Vector3d t;             ///< of X
};

/** \param[in] weight of the link's information */
void
computeTerms(const LinkMeasurement& link,
             const LinkGeometry& geometry,
             double weight,
             LinkTerms& terms);

} // namespace pcl6d::graph_relaxation
