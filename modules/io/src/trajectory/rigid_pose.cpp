// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/rigid_pose.h"

#include <pcl6d/common/number_range.h>
#include <pcl6d/common/pose.h>

#include <cmath>

namespace pcl6d::io {

namespace {

constexpr double kNormTolerance = 1e-2; // of a quaternion; forgives 3 digits

/** \throws IoFailed the position is invalid, see isPlace() */
void
requirePlace(const std::filesystem::path& path,
             std::size_t line,
             const Eigen::Vector3d& t)
{
  if (!isPlace(t))
    text::failAt(path, line, "the position is 1e9 m or farther from the origin");
}

std::string
number(double value)
{
  std::string text;
  text::appendNumber(text, value);
  return text;
}

/** \return why the numbers are no rigid motion */
std::string
whyNotRigid(const Eigen::Isometry3d& pose)
{
  const Eigen::Matrix3d R = pose.linear();
  if (!R.allFinite() || !pose.translation().allFinite())
    return "a number is not finite";
  if (R.determinant() < 0)
    return "its rotation mirrors: determinant " + number(R.determinant());
  const double error =
      (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return "largest entry of |R^T R - I| is " + number(error);
}

} // namespace

Eigen::Isometry3d
rigidPose(const std::filesystem::path& path,
          std::size_t line,
          const Eigen::Matrix3d& R,
          const Eigen::Vector3d& t)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = R;
  pose.translation() = t;
  if (!isRigid(pose))
    text::failAt(path, line, "not a rigid motion (" + whyNotRigid(pose) + ")");
  requirePlace(path, line, t);
  pose.linear() = nearestRotation(R);
  return pose;
}

Eigen::Isometry3d
rigidPose(const std::filesystem::path& path,
          std::size_t line,
          const Eigen::Quaterniond& q,
          const Eigen::Vector3d& t)
{
  if (!t.allFinite() || !q.coeffs().allFinite())
    text::failAt(path, line, "not a rigid motion (a number is not finite)");
  if (std::abs(q.norm() - 1) > kNormTolerance)
    text::failAt(path,
                 line,
                 "not a rigid motion (the quaternion has norm " + number(q.norm()) +
                     ", but must have 1)");
  requirePlace(path, line, t);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = t;
  return pose;
}

} // namespace pcl6d::io
