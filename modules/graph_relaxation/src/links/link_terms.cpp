// SPDX-License-Identifier: BSD-3-Clause
#include "links/link_terms.h"

#include <pcl6d/common/rotation.h>

namespace pcl6d::graph_relaxation {

namespace {
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/** The error pose q, t as 6-vector. */
Vector6
errorVector(const Quaterniond& q, const Vector3d& t)
{
  Vector6 error;
  error.head<3>() = t;
  error.tail<3>() = 2 * q.vec();
  return error;
}

/** \return [t]x M */
Matrix3d
crossed(const Vector3d& t, const Matrix3d& M)
{
  Matrix3d result;
  for (int j = 0; j < 3; ++j)
    result.col(j) = t.cross(Vector3d(M.col(j)));
  return result;
}
} // namespace

Eigen::Isometry3d
QuaternionPose::isometry() const
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = q.toRotationMatrix();
  T.translation() = t;
  return T;
}

QuaternionPose
QuaternionPose::moved(const Vector6& motion) const
{
  QuaternionPose result;
  result.t = t + q * Vector3d(motion.head<3>());
  const Vector3d half = 0.5 * motion.tail<3>();
  result.q = (q * Quaterniond(1, half.x(), half.y(), half.z())).normalized();
  return result;
}

LinkMeasurement::LinkMeasurement(const PoseLink& link)
: T_from_to(link.T_from_to), information(link.information)
{}

Vector6
errorOf(const LinkMeasurement& link, const QuaternionPose& a, const QuaternionPose& b)
{
  const Vector3d t = a.q.conjugate() * Vector3d(b.t - a.t);
  const Quaterniond inverse = link.T_from_to.q.conjugate();
  return errorVector(canonical(inverse * (a.q.conjugate() * b.q)),
                     inverse * Vector3d(t - link.T_from_to.t));
}

LinkGeometry::LinkGeometry(const LinkMeasurement& link,
                           const QuaternionPose& a,
                           const QuaternionPose& b)
{
  const Quaterniond X = a.q.conjugate() * b.q;
  t = a.q.conjugate() * Vector3d(b.t - a.t);
  R = X.toRotationMatrix();
  const Quaterniond inverse = link.T_from_to.q.conjugate();
  const Quaterniond q = canonical(inverse * X);
  error = errorVector(q, inverse * Vector3d(t - link.T_from_to.t));
  J_translation = q.toRotationMatrix();
  J_rotation = q.w() * Matrix3d::Identity() + skew(q.vec());
}

void
computeTerms(const LinkMeasurement& link,
             const LinkGeometry& geometry,
             double weight,
             LinkTerms& terms)
{
  const Matrix3d &A = geometry.J_translation, &B = geometry.J_rotation;
  const Matrix3d &R = geometry.R, Rt = R.transpose();
  const Matrix6 information = weight * link.information;
  // By the pose b: J_to is block diagonal.
  const Matrix3d tt = A.transpose() * information.topLeftCorner<3, 3>() * A;
  const Matrix3d tr = A.transpose() * information.topRightCorner<3, 3>() * B;
  const Matrix3d rr = B.transpose() * information.bottomRightCorner<3, 3>() * B;
  terms.H_to << tt, tr, tr.transpose(), rr;
  const Vector6 force = information * geometry.error;
  terms.g_to.head<3>() = A.transpose() * force.head<3>();
  terms.g_to.tail<3>() = B.transpose() * force.tail<3>();
  // By the pose a: J_from = -J_to Ad with Ad = [R^T, -R^T [t]x; 0, R^T].
  const Matrix3d top_left = R * tt, top_right = R * tr;
  const Matrix3d low_left = crossed(geometry.t, top_left) + R * tr.transpose();
  const Matrix3d low_right = crossed(geometry.t, top_right) + R * rr;
  terms.H_from_to << -top_left, -top_right, -low_left, -low_right;
  const Matrix3d from_tt = top_left * Rt, from_rt = low_left * Rt;
  // M [t]x = ([t]x^T M^T)^T = -([t]x M^T)^T
  const Matrix3d from_rr =
      crossed(geometry.t, from_rt.transpose()).transpose() + low_right * Rt;
  terms.H_from << from_tt, from_rt.transpose(), from_rt, from_rr;
  terms.g_from.head<3>() = -(R * terms.g_to.head<3>());
  terms.g_from.tail<3>() =
      geometry.t.cross(Vector3d(terms.g_from.head<3>())) - R * terms.g_to.tail<3>();
}

} // namespace pcl6d::graph_relaxation
