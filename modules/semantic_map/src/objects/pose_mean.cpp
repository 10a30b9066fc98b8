// SPDX-License-Identifier: BSD-3-Clause
#include "objects/pose_mean.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/pose.h>

#include <cmath>

namespace pcl6d::semantic_map {

Matrix6d
eulerJacobian(const Eigen::Matrix3d& R)
{
  // R = Rz(yaw) Ry(pitch) Rx(roll); the axes of the three turns, in the world
  const double cos_pitch = std::sqrt(R(0, 0) * R(0, 0) + R(1, 0) * R(1, 0));
  const double cos_yaw = cos_pitch > 0 ? R(0, 0) / cos_pitch : 1;
  const double sin_yaw = cos_pitch > 0 ? R(1, 0) / cos_pitch : 0;
  Matrix6d G = Matrix6d::Identity();
  G.block<3, 1>(3, 3) << cos_yaw * cos_pitch, sin_yaw * cos_pitch, R(2, 0);
  G.block<3, 1>(3, 4) << -sin_yaw, cos_yaw, 0;
  G.block<3, 1>(3, 5) << 0, 0, 1;
  return G;
}

Vector6d
poseError(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b)
{
  Vector6d error;
  error << b.translation() - a.translation(),
      rotationVector(b.linear() * a.linear().transpose());
  return error;
}

Eigen::Isometry3d
nearestEquivalent(const Eigen::Isometry3d& pose,
                  const Eigen::Isometry3d& to,
                  int symmetry)
{
  if (symmetry == 1)
    return pose;
  // trace(M Rz(a)) = a part without a + C cos a + S sin a is to be largest
  const Eigen::Matrix3d M = to.linear().transpose() * pose.linear();
  const double C = M(0, 0) + M(1, 1), S = M(0, 1) - M(1, 0);
  double angle = portableAtan2(S, C);
  if (symmetry > 1) {
    constexpr double kTurn = 6.283185307179586; // [rad]
    const double step = kTurn / symmetry;
    angle = std::round(angle / step) * step;
  }
  const SinCos turn = portableSinCos(angle);
  Eigen::Matrix3d Rz = Eigen::Matrix3d::Identity();
  Rz.topLeftCorner<2, 2>() << turn.cos, -turn.sin, turn.sin, turn.cos;
  Eigen::Isometry3d turned = pose;
  turned.linear() = pose.linear() * Rz;
  return turned;
}

PoseMean
robustMean(const std::vector<UncertainPose>& poses, std::size_t start, double gate)
{
  constexpr int kMostSteps = 30;
  constexpr double kSmallStep = 1e-12; // [m], [rad]
  PoseMean mean;
  mean.pose = poses[start].pose;
  mean.covariance = poses[start].covariance;
  mean.counts.assign(poses.size(), false);
  mean.counts[start] = true;
  for (int step = 0; step < kMostSteps; ++step) {
    Matrix6d H = Matrix6d::Zero();
    Vector6d g = Vector6d::Zero();
    const std::vector<bool> before = mean.counts;
    mean.counts.clear();
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const Vector6d error = poseError(mean.pose, poses[i].pose);
      const Vector6d pull = poses[i].information * error;
      // a pose outside the mean differs from the mean by the errors of both
      const Vector6d whitened =
          before[i] ? pull
                    : solveSymmetric<6>(poses[i].covariance + mean.covariance, error);
      mean.counts.push_back(error.dot(whitened) <= gate);
      if (!mean.counts.back())
        continue;
      H += poses[i].information;
      g += pull;
    }
    if (H.isZero(0)) { // every pose is outside the gate: keep the start
      mean.pose = poses[start].pose;
      mean.counts.assign(poses.size(), false);
      mean.counts[start] = true;
      mean.covariance = poses[start].covariance;
      return mean;
    }
    const Vector6d change = solveSymmetric(H, g);
    mean.pose.translation() += change.head<3>();
    mean.pose.linear() =
        nearestRotation(rotationFromVector(change.tail<3>()) * mean.pose.linear());
    mean.covariance = inverted(H);
    if (change.norm() < kSmallStep && before == mean.counts)
      break;
  }
  return mean;
}

} // namespace pcl6d::semantic_map
