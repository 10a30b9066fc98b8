// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/name_table.h>
#include <pcl6d/graph_relaxation/parameterisations.h>

#include <cmath>
#include <utility>

namespace pcl6d {

namespace {
constexpr double kGimbalCosine = 0.1;
constexpr double kLargestChange = 0.5; ///< [rad] of the angles at once

constexpr Named<Relaxation> kRelaxations[] = {
    {Relaxation::kHelix, "helix"},
    {Relaxation::kEuler, "euler"},
    {Relaxation::kQuaternion, "quaternion"},
    {Relaxation::kQuaternionPublished, "quaternion-published"},
    {Relaxation::kSmallAngle, "small-angle"}};

Eigen::Isometry3d
poseAt(const Eigen::Vector3d& t, const Eigen::Quaterniond& q)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = t;
  return pose;
}
} // namespace

std::vector<std::string>
relaxationNames()
{
  return namesOf(kRelaxations);
}

Relaxation
relaxationFromName(const std::string& name)
{
  return fromName(kRelaxations, "relaxation", name);
}

const char*
toString(Relaxation relaxation)
{
  return nameOf(kRelaxations, relaxation);
}

Eigen::Isometry3d
moveByHelix(const Eigen::Isometry3d& pose, const Twist& X)
{
  const Eigen::Isometry3d motion = motionFromTwist(-X);
  return poseAt(pose.translation() + motion.translation(),
                Eigen::Quaterniond(motion.linear() * pose.linear()));
}

Eigen::Isometry3d
moveByEuler(const Eigen::Isometry3d& pose, const Twist& X)
{
  const EulerAngles angles = eulerFromRotation(pose.linear());
  const Eigen::Matrix3d J = eulerRates(angles);
  if (std::abs(J.determinant()) < kGimbalCosine)
    return moveByHelix(pose, X);
  const Eigen::Vector3d change = J.inverse() * X.tail<3>();
  if (change.norm() > kLargestChange)
    return moveByHelix(pose, X);
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.linear() = rotationFromEuler(
      {angles.roll - change.x(), angles.pitch - change.y(), angles.yaw - change.z()});
  moved.translation() = pose.translation() - X.head<3>();
  return moved;
}

Eigen::Isometry3d
moveByQuaternion(const Eigen::Isometry3d& pose, const Twist& X)
{
  Eigen::Matrix<double, 7, 1> scaled;
  scaled << X.head<3>(), 0, X.tail<3>();
  return moveByScaledQuaternion(pose, scaled);
}

Eigen::Isometry3d
moveByScaledQuaternion(const Eigen::Isometry3d& pose,
                       const Eigen::Matrix<double, 7, 1>& X)
{
  const Eigen::Vector4d half = 0.5 * X.tail<4>();
  const Eigen::Quaterniond change(1 - half(0), -half(1), -half(2), -half(3));
  return poseAt(pose.translation() - X.head<3>(),
                change * Eigen::Quaterniond(pose.linear()));
}

Eigen::Matrix<double, 6, 6>
eulerCovariance(const Eigen::Isometry3d& pose,
                const Eigen::Matrix<double, 6, 6>& covariance)
{
  Eigen::Matrix<double, 6, 6> H_inverse = Eigen::Matrix<double, 6, 6>::Identity();
  H_inverse.bottomRightCorner<3, 3>() =
      eulerRates(eulerFromRotation(pose.linear())).inverse();
  return H_inverse * covariance * H_inverse.transpose();
}

Eigen::Matrix<double, 6, 6>
twistCovariance(const Eigen::Isometry3d& pose,
                const Eigen::Matrix<double, 6, 6>& covariance)
{
  Eigen::Matrix<double, 6, 6> H = Eigen::Matrix<double, 6, 6>::Identity();
  H.bottomRightCorner<3, 3>() = eulerRates(eulerFromRotation(pose.linear()));
  return H * covariance * H.transpose();
}

Eigen::Matrix<double, 6, 6>
covarianceAbout(const Eigen::Vector3d& origin,
                const Eigen::Isometry3d& pose,
                const Eigen::Matrix<double, 6, 6>& covariance)
{
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Identity();
  A.topRightCorner<3, 3>() = skew(pose.translation() - origin);
  return A * covariance * A.transpose();
}

} // namespace pcl6d
