// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/registration/pcl/gicp6d.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace pcl6d {
namespace registration {

Eigen::Matrix3d
checkedCovariance(const Eigen::Matrix3d& covariance,
                  const char* name,
                  std::size_t index)
{
  constexpr double kSymmetric = 1e-6;  // roundings of float, of the largest entry
  constexpr double kLeastShare = 1e-9; // of the largest eigenvalue: still
                                       // invertible in double
  const double largest = covariance.cwiseAbs().maxCoeff();
  const Eigen::Matrix3d C = (covariance + covariance.transpose()) / 2;
  const bool is_symmetric =
      covariance.allFinite() && largest > 0 &&
      (covariance - covariance.transpose()).cwiseAbs().maxCoeff() <=
          kSymmetric * largest;
  SymmetricEigen<3> eigen;
  if (is_symmetric)
    eigen = symmetricEigen<3>(C);
  if (!is_symmetric || eigen.values(0) < -kSymmetric * eigen.values(2))
    throw BadArgument(std::string("GICP6D: covariance ") + std::to_string(index) +
                      " of " + name + " is not symmetric and positive");
  if (eigen.values(0) >= kLeastShare * eigen.values(2))
    return C;
  const Eigen::Vector3d bounded = eigen.values.cwiseMax(kLeastShare * eigen.values(2));
  return eigen.vectors * bounded.asDiagonal() * eigen.vectors.transpose();
}

Normals
leastDirections(const Covariances& covariances)
{
  Normals normals;
  normals.reserve(covariances.size());
  for (const auto& C : covariances)
    normals.emplace_back(symmetricEigen<3>(C).vectors.col(0).cast<float>());
  return normals;
}

bool
arePlanes(const Covariances& covariances, double epsilon)
{
  constexpr double kRounding = 1e-6; // of float
  return std::all_of(covariances.begin(), covariances.end(), [epsilon](const auto& C) {
    const Eigen::Vector3d values = symmetricEigenvalues<3>(C);
    return (values - Eigen::Vector3d(epsilon, 1, 1)).cwiseAbs().maxCoeff() <= kRounding;
  });
}

Eigen::Matrix3d
covarianceOf(const Eigen::Vector3f& normal, double epsilon)
{
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  if (normal.allFinite())
    n = normal.cast<double>();
  return Eigen::Matrix3d::Identity() - (1 - epsilon) * n * n.transpose();
}

Covariances
covariancesOf(const Normals& normals, double epsilon)
{
  Covariances covariances;
  covariances.reserve(normals.size());
  for (const auto& normal : normals)
    covariances.push_back(covarianceOf(normal, epsilon));
  return covariances;
}

Eigen::Matrix3d
mahalanobisOf(const Eigen::Matrix3d& R,
              const Eigen::Matrix3d& of_source,
              const Eigen::Matrix3d& of_target)
{
  return (of_target + R * of_source * R.transpose()).inverse();
}

RigidEstimate
gicpStep(const GicpSides& sides,
         const Eigen::Isometry3d& T,
         const std::vector<IcpPair>& pairs,
         const IcpOptions& options)
{
  constexpr std::size_t kPairs = 256;
  std::vector<PlaneSums> partials((pairs.size() + kPairs - 1) / kPairs);
  parallelBlocks(pairs.size(), kPairs, options.num_threads, [&](const Block& block) {
    PlaneAccumulator sums;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const auto s = static_cast<std::size_t>(pairs[i].source);
      const auto t = static_cast<std::size_t>(pairs[i].target);
      sums.addNorm(T * sides.source[s].cast<double>(),
                   sides.target[t].cast<double>(),
                   mahalanobisOf(T.linear(), sides.of_source[s], sides.of_target[t]));
    }
    partials[block.index] = sums.sums();
  });
  return options.plane_minimiser(mergeTree(std::move(partials), &PlaneSums::merge));
}

Eigen::Vector3d
derivativeByAngles(const Eigen::Vector3d& roll_pitch_yaw,
                   const Eigen::Matrix3d& dCost_dR_T)
{
  // The rotation about each axis, and its derivative by the angle.
  Eigen::Matrix3d turn[3], change[3];
  for (int axis = 0; axis < 3; ++axis) {
    const SinCos a = portableSinCos(roll_pitch_yaw[axis]);
    const int j = (axis + 1) % 3, k = (axis + 2) % 3;
    turn[axis].setIdentity();
    change[axis].setZero();
    turn[axis](j, j) = turn[axis](k, k) = a.cos;
    turn[axis](k, j) = a.sin;
    turn[axis](j, k) = -a.sin;
    change[axis](j, j) = change[axis](k, k) = -a.sin;
    change[axis](k, j) = a.cos;
    change[axis](j, k) = -a.cos;
  }
  return {(turn[2] * turn[1] * change[0] * dCost_dR_T).trace(),
          (turn[2] * change[1] * turn[0] * dCost_dR_T).trace(),
          (change[2] * turn[1] * turn[0] * dCost_dR_T).trace()};
}

} // namespace registration

PCL6D_DEFINE_PAIR_INSTANCES(GICP6D)
} // namespace pcl6d
