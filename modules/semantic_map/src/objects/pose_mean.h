// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/semantic_map/object_fusion.h>

#include <Eigen/Geometry>

#include <optional>
#include <vector>

/** \file The mean of poses with covariances. Internal to the module semantic_map. */
namespace pcl6d::semantic_map {

using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/** \brief A pose and the covariance of its error: position [m] and rotation vector [rad],
 * both in the axes of the world. */
struct UncertainPose {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Identity();
  Matrix6d information = Matrix6d::Identity(); ///< its inverse
};

/** \return G, the Jacobian from x y z roll pitch yaw to position and rotation vector in
 * the axes of the world */
Matrix6d
eulerJacobian(const Eigen::Matrix3d& R);

/** \brief The mean. */
struct PoseMean {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  std::vector<bool> counts; ///< per pose: within the gate
  Matrix6d covariance = Matrix6d::Identity();
};

/** \return (t_b - t_a, log(R_b R_a^T)) */
Vector6d
poseError(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b);

/** \return the equivalent pose, turned about its z axis, that is nearest to another
 * pose
 * \param[in] symmetry see MapObject::symmetry */
Eigen::Isometry3d
nearestEquivalent(const Eigen::Isometry3d& pose,
                  const Eigen::Isometry3d& to,
                  int symmetry);

/** \brief The mean weighted by information, without poses beyond the gate.
 * \param[in] poses at least one \param[in] start index of the first estimate */
PoseMean
robustMean(const std::vector<UncertainPose>& poses, std::size_t start, double gate);

} // namespace pcl6d::semantic_map
