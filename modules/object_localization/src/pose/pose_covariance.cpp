// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/pose.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/object_localization/pose_covariance.h>

#include <cmath>

namespace pcl6d {

namespace {
using Vector6d = Eigen::Matrix<double, 6, 1>;

Vector6d
coordinates(const Eigen::Isometry3d& T)
{
  const EulerAngles angles = eulerFromRotation(T.linear());
  Vector6d x;
  x << T.translation(), angles.roll, angles.pitch, angles.yaw;
  return x;
}

Eigen::Isometry3d
poseAt(const Vector6d& x)
{
  return poseFromEuler(x.head<3>(), {x[3], x[4], x[5]});
}

bool
hasEulerAngles(const Eigen::Isometry3d& T)
{
  constexpr double kNearPole = 1e-3;
  return std::hypot(T(0, 0), T(1, 0)) > kNearPole; // cosine of the pitch
}

/** Carries a covariance through a function of the pose, by central differences. */
template <typename Function>
std::optional<PoseCovariance>
carried(const PoseCovariance& covariance, const Eigen::Isometry3d& T, Function function)
{
  if (!hasEulerAngles(T) || !hasEulerAngles(function(T)))
    return {};
  constexpr double kStep = 1e-6; // [m], [rad]
  const Vector6d x = coordinates(T);
  Eigen::Matrix<double, 6, 6> jacobian;
  for (int i = 0; i < 6; ++i) {
    const Vector6d step = kStep * Vector6d::Unit(i);
    Vector6d change = coordinates(function(poseAt(x + step))) -
                      coordinates(function(poseAt(x - step)));
    for (int k = 3; k < 6; ++k) // across half a turn
      change[k] -= 2 * M_PI * std::round(change[k] / (2 * M_PI));
    jacobian.col(i) = change / (2 * kStep);
  }
  const PoseCovariance made = jacobian * covariance * jacobian.transpose();
  return PoseCovariance((made + made.transpose()) / 2);
}
} // namespace

std::optional<PoseCovariance>
inverseCovariance(const PoseCovariance& covariance, const Eigen::Isometry3d& T_a_b)
{
  return carried(covariance, T_a_b, [](const Eigen::Isometry3d& T) {
    return Eigen::Isometry3d(T.inverse());
  });
}

std::optional<PoseCovariance>
movedCovariance(const PoseCovariance& covariance,
                const Eigen::Isometry3d& T_c_a,
                const Eigen::Isometry3d& T_a_b)
{
  return carried(covariance, T_a_b, [&](const Eigen::Isometry3d& T) {
    return Eigen::Isometry3d(T_c_a * T);
  });
}

} // namespace pcl6d
