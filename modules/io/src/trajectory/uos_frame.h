// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

/** \file 3DTK's frame: left-handed, x right, y up, z forward, in centimetres. Ours is
 * right-handed, x forward, y left, z up, in metres. */
namespace pcl6d::io {

/** \return a position of 3DTK [cm] in our frame [m] */
template <typename Scalar>
Eigen::Matrix<Scalar, 3, 1>
fromUos(const Eigen::Matrix<Scalar, 3, 1>& p)
{
  return Eigen::Matrix<Scalar, 3, 1>(p.z(), -p.x(), p.y()) / 100;
}

/** \return the matrix from 3DTK's coordinates to ours; mirrors, so det = -1 */
inline Eigen::Matrix3d
axesFromUos()
{
  return (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, 1, 0).finished();
}

/** \return a pose of 3DTK [cm] in our frame [m] */
inline Eigen::Isometry3d
poseFromUos(const Eigen::Matrix3d& R, const Eigen::Vector3d& t)
{
  const Eigen::Matrix3d C = axesFromUos();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = C * R * C.transpose();
  pose.translation() = fromUos(t);
  return pose;
}

/** \return the pose [m] in 3DTK's convention, a 4x4 matrix [cm] */
inline Eigen::Matrix4d
poseToUos(const Eigen::Isometry3d& pose)
{
  const Eigen::Matrix3d C = axesFromUos();
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() = C.transpose() * pose.linear() * C;
  T.topRightCorner<3, 1>() = 100 * (C.transpose() * pose.translation());
  return T;
}

} // namespace pcl6d::io
