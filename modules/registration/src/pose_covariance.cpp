// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/portable_math.h>
#include <pcl6d/registration/pose_covariance.h>
#include <pcl6d/registration/twist.h>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace pcl6d {

std::optional<PoseCovariance>
poseCovariance(const PairSums& sums, const Eigen::Isometry3d& T_world_scan)
{
  const EulerAngles angles = eulerFromRotation(T_world_scan.linear());
  if (sums.count < 3 || std::abs(portableSinCos(angles.pitch).cos) < 1e-3)
    return std::nullopt;
  // About the centroid of the points M^T M falls apart into two 3x3 blocks.
  const Eigen::Matrix3d turning =
      sums.sourceSq() * Eigen::Matrix3d::Identity() - sums.scatter;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(turning);
  if (!(solver.eigenvalues()(0) > 1e-12 * solver.eigenvalues()(2)))
    return std::nullopt;
  const double degrees_of_freedom = 3 * sums.weight - 6;
  const double variance =
      sums.errorSq(Eigen::Isometry3d::Identity()) / std::max(1.0, degrees_of_freedom);
  PoseCovariance of_twist = PoseCovariance::Zero();
  of_twist.topLeftCorner<3, 3>().diagonal().setConstant(variance / sums.weight);
  of_twist.bottomRightCorner<3, 3>() = variance * turning.inverse();

  PoseCovariance H_inverse = PoseCovariance::Identity();
  H_inverse.topRightCorner<3, 3>() =
      -skew(T_world_scan.translation() - sums.mean_source);
  H_inverse.bottomRightCorner<3, 3>() = eulerRates(angles).inverse();
  return PoseCovariance(H_inverse * of_twist * H_inverse.transpose());
}

} // namespace pcl6d
