// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/rotation.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

Eigen::Matrix3d
rotationFromEuler(const EulerAngles& angles)
{
  const auto [sr, cr] = portableSinCos(angles.roll);
  const auto [sp, cp] = portableSinCos(angles.pitch);
  const auto [sy, cy] = portableSinCos(angles.yaw);
  Eigen::Matrix3d R;
  R << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr, //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,  //
      -sp, cp * sr, cp * cr;
  return R;
}

EulerAngles
eulerFromRotation(const Eigen::Matrix3d& R)
{
  const double cos_pitch = std::sqrt(R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0));
  EulerAngles angles;
  angles.pitch = portableAtan2(-R(2, 0), cos_pitch);
  if (cos_pitch < 1e-6) { // gimbal lock: only roll -+ yaw is determined; yaw stays 0
    const double sign = R(2, 0) < 0 ? 1.0 : -1.0;
    angles.roll = portableAtan2(sign * R(0, 1), R(1, 1));
    return angles;
  }
  angles.roll = portableAtan2(R(2, 1), R(2, 2));
  angles.yaw = portableAtan2(R(1, 0), R(0, 0));
  return angles;
}

Eigen::Matrix3d
skew(const Eigen::Vector3d& v)
{
  Eigen::Matrix3d S;
  S << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return S;
}

Eigen::Matrix3d
rotationFromVector(const Eigen::Vector3d& w)
{
  const double angle = w.norm();
  const Eigen::Matrix3d W = skew(w);
  if (angle < 1e-8)
    return Eigen::Matrix3d::Identity() + W + 0.5 * W * W;
  const Eigen::Matrix3d K = W / angle;
  // 1 - cos as 2 sin^2 of the half angle: no cancellation for small angles.
  const double half_sine = portableSinCos(0.5 * angle).sin;
  return Eigen::Matrix3d::Identity() + portableSinCos(angle).sin * K +
         2 * half_sine * half_sine * K * K;
}

Eigen::Vector3d
rotationVector(const Eigen::Matrix3d& R)
{
  const Eigen::Quaterniond q = canonical(Eigen::Quaterniond(R));
  const double half_sine = q.vec().norm();
  if (half_sine < 1e-12)
    return 2 * q.vec();
  return q.vec() * (2 * portableAtan2(half_sine, q.w()) / half_sine);
}

double
rotationAngle(const Eigen::Matrix3d& R)
{
  return rotationVector(R).norm();
}

Eigen::Matrix3d
slerp(const Eigen::Matrix3d& R0, const Eigen::Matrix3d& R1, double s)
{
  return rotationFromVector(s * rotationVector(R1 * R0.transpose())) * R0;
}

Eigen::Matrix3d
nearestRotation(const Eigen::Matrix3d& A)
{
  const SingularValues svd = singularValues(A);
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  sign(2) = (svd.U * svd.V.transpose()).determinant() < 0 ? -1 : 1;
  return svd.U * sign.asDiagonal() * svd.V.transpose();
}

// Eigen's FromTwoVectors() uses a singular value decomposition for opposite directions: 11 s of
// compile time in each file that calls the function.
Eigen::Quaterniond
shortestRotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
  constexpr double kOpposite = 1e-12; // 1 + cosine: within 1.4e-6 rad of opposite
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  Eigen::Quaterniond q;
  if (cosine < -1 + kOpposite) {
    const double w_squared = 0.5 * (1 + std::max(cosine, -1.0));
    q.w() = std::sqrt(w_squared);
    q.vec() = a.unitOrthogonal() * std::sqrt(1 - w_squared);
  }
  else {
    const double twice_w = std::sqrt(2 * (1 + cosine));
    q.vec() = a.cross(b) * (1 / twice_w);
    q.w() = 0.5 * twice_w;
  }
  return q;
}

Eigen::Quaterniond
canonical(const Eigen::Quaterniond& q)
{
  return q.w() < 0 ? Eigen::Quaterniond(-q.coeffs()) : q;
}

double
wrapAngle(double angle)
{
  const double wrapped = std::remainder(angle, 2 * M_PI); // in [-pi, pi]
  return wrapped <= -M_PI ? M_PI : wrapped;
}

} // namespace pcl6d
