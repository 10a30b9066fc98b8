// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/pose_graph.h>
#include <pcl6d/common/rotation.h>

#include <Eigen/Eigenvalues>

#include <array>
#include <ceres/ceres.h>

/** \file Pose graphs for Ceres: an oracle in the tests, a peer in the benchmarks. Its
 * mathematics is written apart from ours. */
namespace pcl6d::test {

/** Position, then quaternion x y z w. */
using CeresPose = std::array<double, 7>;

/** \brief T <- T [R(dr), dt], whose derivatives the cost gives directly. */
class CeresPoseManifold : public ceres::Manifold {
public:
  int
  AmbientSize() const override
  {
    return 7;
  }
  int
  TangentSize() const override
  {
    return 6;
  }
  bool
  Plus(const double* x, const double* delta, double* result) const override
  {
    const Eigen::Map<const Eigen::Vector3d> t(x), dt(delta), dr(delta + 3);
    const Eigen::Map<const Eigen::Quaterniond> q(x + 3);
    const Eigen::Quaterniond turn(rotationFromVector(dr));
    Eigen::Map<Eigen::Vector3d> moved(result);
    moved = t + q * Eigen::Vector3d(dt);
    Eigen::Map<Eigen::Quaterniond>(result + 3) = (q * turn).normalized();
    return true;
  }
  bool
  PlusJacobian(const double*, double* jacobian) const override
  {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>>(jacobian).setIdentity();
    return true;
  }
  bool
  Minus(const double*, const double*, double*) const override
  {
    return false; // not needed by the solver
  }
  bool
  MinusJacobian(const double*, double* jacobian) const override
  {
    Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>>(jacobian).setIdentity();
    return true;
  }
};

/** \brief The root of information times (t, 2 vec(q)) of T_from_to^-1 T_a^-1 T_b. */
class CeresLink : public ceres::SizedCostFunction<6, 7, 7> {
public:
  explicit CeresLink(const PoseLink& link)
  : t_(link.T_from_to.translation()), q_(link.T_from_to.linear())
  {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(
        link.information);
    root_ = solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() *
            solver.eigenvectors().transpose();
  }

  bool
  Evaluate(double const* const* poses, double* residuals, double** J) const override
  {
    using Eigen::Matrix3d, Eigen::Quaterniond, Eigen::Vector3d;
    using Jacobian = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;
    const Eigen::Map<const Vector3d> t_a(poses[0]), t_b(poses[1]);
    const Eigen::Map<const Quaterniond> q_a(poses[0] + 3), q_b(poses[1] + 3);
    const Matrix3d measured = q_.conjugate().toRotationMatrix(); // R_from_to^T
    const Vector3d between = q_a.conjugate() * Vector3d(t_b - t_a);
    const Quaterniond q = canonical(q_.conjugate() * q_a.conjugate() * q_b);
    Eigen::Matrix<double, 6, 1> error;
    error << measured * (between - t_), 2 * q.vec();
    Eigen::Map<Eigen::Matrix<double, 6, 1>> out(residuals);
    out = root_ * error;
    if (!J)
      return true;
    Eigen::Matrix<double, 6, 6> local = Eigen::Matrix<double, 6, 6>::Zero();
    if (J[0]) {
      // The error's left factor of q is turned by -R_from_to^T dr.
      local.topLeftCorner<3, 3>() = -measured;
      local.topRightCorner<3, 3>() = measured * skew(between);
      local.bottomRightCorner<3, 3>() =
          -(q.w() * Matrix3d::Identity() - skew(q.vec())) * measured;
      Eigen::Map<Jacobian>(J[0]) << root_ * local, Eigen::Matrix<double, 6, 1>::Zero();
    }
    if (J[1]) {
      local.setZero();
      local.topLeftCorner<3, 3>() = (q_.conjugate() * q_a.conjugate() * q_b).matrix();
      local.bottomRightCorner<3, 3>() = q.w() * Matrix3d::Identity() + skew(q.vec());
      Eigen::Map<Jacobian>(J[1]) << root_ * local, Eigen::Matrix<double, 6, 1>::Zero();
    }
    return true;
  }

private:
  Eigen::Vector3d t_;
  Eigen::Quaterniond q_;
  Eigen::Matrix<double, 6, 6> root_;
};

/** \brief Optimises a connected graph with its first pose fixed, by steps of
 * Gauss-Newton. \param[in] library its own sparse Cholesky (EIGEN_SPARSE) or CHOLMOD
 * (SUITE_SPARSE) \param[in] chi2_epsilon the share by which the last step lowers chi2
 * \param[out] chi2 at the end */
inline std::vector<Eigen::Isometry3d>
optimizeByCeres(const PoseGraph& graph,
                ceres::SparseLinearAlgebraLibraryType library,
                double chi2_epsilon,
                int num_threads,
                double* chi2)
{
  std::vector<CeresPose> poses(graph.poses.size());
  CeresPoseManifold manifold;
  ceres::Problem::Options ownership;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Eigen::Map<Eigen::Vector3d>(poses[i].data()) = graph.poses[i].translation();
    Eigen::Map<Eigen::Quaterniond>(poses[i].data() + 3) =
        Eigen::Quaterniond(graph.poses[i].linear());
    problem.AddParameterBlock(poses[i].data(), 7, &manifold);
  }
  for (const auto& link : graph.links)
    problem.AddResidualBlock(
        new CeresLink(link), nullptr, poses[link.from].data(), poses[link.to].data());
  problem.SetParameterBlockConstant(poses[0].data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = library;
  options.initial_trust_region_radius = 1e16; // no damping: Gauss-Newton
  options.max_trust_region_radius = 1e16;
  options.max_num_iterations = 100;
  options.function_tolerance = chi2_epsilon;
  options.num_threads = num_threads;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  *chi2 = 2 * summary.final_cost;
  std::vector<Eigen::Isometry3d> result(poses.size(), Eigen::Isometry3d::Identity());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    result[i].translation() = Eigen::Map<Eigen::Vector3d>(poses[i].data());
    result[i].linear() =
        Eigen::Map<Eigen::Quaterniond>(poses[i].data() + 3).toRotationMatrix();
  }
  return result;
}

} // namespace pcl6d::test
