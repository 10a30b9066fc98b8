// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/pose.h>

namespace pcl6d {

Eigen::Isometry3d
planarPose(double x, double y, double yaw)
{
  return poseFromEuler({x, y, 0}, {0, 0, yaw});
}

Eigen::Isometry3d
poseFromEuler(const Eigen::Vector3d& t, const EulerAngles& angles)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotationFromEuler(angles);
  pose.translation() = t;
  return pose;
}

Eigen::Isometry3d
extrapolateOdometry(const Eigen::Isometry3d& corrected,
                    const Eigen::Isometry3d& odometry_from,
                    const Eigen::Isometry3d& odometry_to)
{
  return exactlyRigid(corrected * odometry_from.inverse() * odometry_to);
}

Eigen::Isometry3d
exactlyRigid(const Eigen::Isometry3d& pose)
{
  Eigen::Isometry3d rigid = pose;
  rigid.linear() = Eigen::Quaterniond(pose.linear()).normalized().toRotationMatrix();
  return rigid;
}

MotionSize
distanceBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  const Eigen::Isometry3d error = a.inverse() * b;
  return {error.translation().norm(), rotationAngle(error.linear())};
}

bool
isRigid(const Eigen::Isometry3d& pose, double tolerance)
{
  if (!pose.matrix().allFinite())
    return false;
  const Eigen::Matrix3d R = pose.linear();
  const Eigen::Matrix3d residual = R.transpose() * R - Eigen::Matrix3d::Identity();
  return residual.cwiseAbs().maxCoeff() <= tolerance && R.determinant() > 0;
}

Eigen::Vector3d
worldOffset(const Eigen::Isometry3d& first_pose)
{
  constexpr double kFar = 10e3; // [m]
  const Eigen::Vector3d t = first_pose.translation();
  return t.norm() > kFar ? Eigen::Vector3d(t.array().round()) : Eigen::Vector3d::Zero();
}

} // namespace pcl6d
