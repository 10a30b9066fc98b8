// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/registration/pose_information.h>
#include <pcl6d/registration/twist.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
using Matrix6 = PoseInformation;

/** Ratio of eigenvalues below which the pairs do not fix the pose. */
constexpr double kRankTolerance = 1e-12;

/** Normal equations of the twist about the centroid of the points. */
struct TwistSystem {
  Matrix6 A;
  Eigen::Vector3d centroid;
  double variance;  ///< s^2 of the residuals [m^2]
  double spread_sq; ///< mean squared distance from the centroid [m^2]
};

TwistSystem
systemOf(const PairSums& sums)
{
  // About the centroid of the points M^T M falls apart into two 3x3 blocks.
  Matrix6 A = Matrix6::Zero();
  A.topLeftCorner<3, 3>().diagonal().setConstant(sums.weight);
  A.bottomRightCorner<3, 3>() =
      sums.sourceSq() * Eigen::Matrix3d::Identity() - sums.scatter;
  const double error = sums.errorSq(Eigen::Isometry3d::Identity());
  return {A,
          sums.mean_source,
          error / std::max(1.0, 3 * sums.weight - 6),
          sums.sourceSq() / sums.weight};
}

TwistSystem
systemOf(const PlaneSums& sums)
{
  return {sums.A,
          sums.mean_source,
          sums.residual_sq / std::max(1.0, sums.weight - 6),
          sums.sourceSq() / sums.weight};
}

/** Whether roll and yaw are defined, with at least three pairs. */
template <typename Sums>
bool
hasAngles(const Sums& sums, const EulerAngles& angles)
{
  return sums.count >= 3 && std::abs(portableSinCos(angles.pitch).cos) >= 1e-3;
}

/** \return the inverse, if no direction is open */
std::optional<Matrix6>
inverseOf(const TwistSystem& system)
{
  Twist unit = Twist::Ones();
  unit.tail<3>().setConstant(system.spread_sq > 0 ? 1 / std::sqrt(system.spread_sq)
                                                  : 1);
  const Matrix6 scaled = unit.asDiagonal() * system.A * unit.asDiagonal();
  const auto eigen = symmetricEigen<6>(scaled);
  const Twist& values = eigen.values;
  if (!(values(0) > kRankTolerance * values(5)))
    return std::nullopt;
  const Matrix6 vectors = unit.asDiagonal() * eigen.vectors;
  return Matrix6(vectors * values.cwiseInverse().asDiagonal() * vectors.transpose());
}

/** Derivative of the twist about the centroid by the pose. */
Matrix6
twistByPose(const TwistSystem& system, const Eigen::Isometry3d& T, const EulerAngles& a)
{
  const Eigen::Matrix3d J = eulerRates(a);
  Matrix6 H = Matrix6::Identity();
  H.topRightCorner<3, 3>() = skew(T.translation() - system.centroid) * J;
  H.bottomRightCorner<3, 3>() = J;
  return H;
}

template <typename Sums>
std::optional<PoseInformation>
informationOf(const Sums& sums, const Eigen::Isometry3d& T_world_scan)
{
  const EulerAngles angles = eulerFromRotation(T_world_scan.linear());
  if (!hasAngles(sums, angles))
    return std::nullopt;
  const TwistSystem system = systemOf(sums);
  if (!(system.variance > 0))
    return std::nullopt;
  const Matrix6 H = twistByPose(system, T_world_scan, angles);
  return PoseInformation(H.transpose() * system.A * H / system.variance);
}

template <typename Sums>
std::optional<PoseCovariance>
covarianceOf(const Sums& sums, const Eigen::Isometry3d& T_world_scan)
{
  const EulerAngles angles = eulerFromRotation(T_world_scan.linear());
  if (!hasAngles(sums, angles))
    return std::nullopt;
  const TwistSystem system = systemOf(sums);
  const auto inverse = inverseOf(system);
  if (!inverse || !(system.variance > 0))
    return std::nullopt;
  Matrix6 H_inverse = Matrix6::Identity();
  H_inverse.topRightCorner<3, 3>() =
      -skew(T_world_scan.translation() - system.centroid);
  H_inverse.bottomRightCorner<3, 3>() = eulerRates(angles).inverse();
  return PoseCovariance(system.variance * H_inverse * *inverse * H_inverse.transpose());
}
} // namespace

std::optional<PoseInformation>
poseInformation(const PairSums& sums, const Eigen::Isometry3d& T_world_scan)
{
  return informationOf(sums, T_world_scan);
}

std::optional<PoseInformation>
poseInformation(const PlaneSums& sums, const Eigen::Isometry3d& T_world_scan)
{
  return informationOf(sums, T_world_scan);
}

std::optional<PoseCovariance>
poseCovariance(const PairSums& sums, const Eigen::Isometry3d& T_world_scan)
{
  return covarianceOf(sums, T_world_scan);
}

std::optional<PoseCovariance>
poseCovariance(const PlaneSums& sums, const Eigen::Isometry3d& T_world_scan)
{
  return covarianceOf(sums, T_world_scan);
}

} // namespace pcl6d
