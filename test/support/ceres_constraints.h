// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/graph_constraints.h>
#include <pcl6d/common/pose_graph.h>

#include <Eigen/Eigenvalues>

#include <array>
#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <vector>

/** \file Pose graphs with landmarks, priors and switches for Ceres, by automatic derivatives: an
 * oracle in which landmarks are points, priors have one pose and switches are unknowns. */
namespace pcl6d::test {

template <int N>
Eigen::Matrix<double, N, N>
rootOfInformation(const Eigen::Matrix<double, N, N>& information)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(information);
  return solver.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal() *
         solver.eigenvectors().transpose();
}

/** (t, 2 vec(q)) of M^-1 A^-1 B, with B given by its quaternion x y z w and position. */
struct CeresError {
  Eigen::Isometry3d measured;
  Eigen::Matrix<double, 6, 6> root;

  template <typename T>
  Eigen::Matrix<T, 6, 1>
  at(const T* a, const T* b) const
  {
    using Quaternion = Eigen::Quaternion<T>;
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Quaternion> qa(a), qb(b);
    const Eigen::Map<const Vector> ta(a + 4), tb(b + 4);
    const Quaternion qm(Eigen::Quaterniond(measured.linear()).cast<T>());
    const Vector tm = measured.translation().cast<T>();
    Quaternion q = qm.conjugate() * qa.conjugate() * qb;
    if (q.w() < T(0))
      q.coeffs() = -q.coeffs();
    Eigen::Matrix<T, 6, 1> error;
    error << qm.conjugate() * (qa.conjugate() * Vector(tb - ta) - tm), T(2) * q.vec();
    return root.cast<T>() * error;
  }
  template <typename T>
  bool
  operator()(const T* a, const T* b, T* out) const
  {
    Eigen::Map<Eigen::Matrix<T, 6, 1>> residual(out);
    residual = at(a, b);
    return true;
  }
  template <typename T>
  bool
  operator()(const T* a, const T* b, const T* s, T* out) const
  {
    Eigen::Map<Eigen::Matrix<T, 6, 1>> residual(out);
    residual = *s * at(a, b);
    return true;
  }
  template <typename T>
  bool
  operator()(const T* b, T* out) const
  {
    const T world[7] = {T(0), T(0), T(0), T(1), T(0), T(0), T(0)};
    return (*this)(world, b, out);
  }
};

struct CeresSighting {
  Eigen::Vector3d measured;
  Eigen::Matrix3d root;

  template <typename T>
  bool
  operator()(const T* a, const T* landmark, T* out) const
  {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Eigen::Quaternion<T>> q(a);
    const Eigen::Map<const Vector> t(a + 4), p(landmark);
    Eigen::Map<Vector> residual(out);
    residual = root.cast<T>() * (q.conjugate() * Vector(p - t) - measured.cast<T>());
    return true;
  }
};

struct CeresSwitch {
  double prior, root;

  template <typename T>
  bool
  operator()(const T* s, T* out) const
  {
    *out = root * (prior - *s);
    return true;
  }
};

struct ConstrainedByCeres {
  std::vector<Eigen::Isometry3d> poses;
  std::vector<Eigen::Vector3d> landmarks;
  std::vector<double> switches;
  double chi2 = 0;
};

/** \brief The optimum; the first pose is fixed unless there are priors. */
inline ConstrainedByCeres
constrainedByCeres(const PoseGraph& graph, const GraphConstraints& constraints)
{
  ConstrainedByCeres result;
  result.landmarks = constraints.landmarks;
  std::vector<std::array<double, 7>> poses(graph.poses.size());
  std::vector<double> switches(graph.links.size(), -1);
  ceres::Problem problem;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Eigen::Map<Eigen::Quaterniond>(poses[i].data()) =
        Eigen::Quaterniond(graph.poses[i].linear());
    Eigen::Map<Eigen::Vector3d>(poses[i].data() + 4) = graph.poses[i].translation();
    problem.AddParameterBlock(
        poses[i].data(),
        7,
        new ceres::ProductManifold<ceres::EigenQuaternionManifold,
                                   ceres::EuclideanManifold<3>>());
  }
  for (const LinkSwitch& one : constraints.switches) {
    switches[one.link] = one.value;
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<CeresSwitch, 1, 1>(
            new CeresSwitch{one.prior, std::sqrt(one.information)}),
        nullptr,
        &switches[one.link]);
  }
  for (std::size_t k = 0; k < graph.links.size(); ++k) {
    const PoseLink& link = graph.links[k];
    auto* const error =
        new CeresError{link.T_from_to, rootOfInformation<6>(link.information)};
    double *const a = poses[link.from].data(), *const b = poses[link.to].data();
    if (switches[k] >= 0)
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<CeresError, 6, 7, 7, 1>(error),
          nullptr,
          a,
          b,
          &switches[k]);
    else
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<CeresError, 6, 7, 7>(error), nullptr, a, b);
  }
  for (const PosePrior& prior : constraints.priors)
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<CeresError, 6, 7>(new CeresError{
            prior.T_world_pose, rootOfInformation<6>(prior.information)}),
        nullptr,
        poses[prior.pose].data());
  for (const LandmarkSighting& sighting : constraints.sightings)
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<CeresSighting, 3, 7, 3>(new CeresSighting{
            sighting.position, rootOfInformation<3>(sighting.information)}),
        nullptr,
        poses[sighting.pose].data(),
        result.landmarks[sighting.landmark].data());
  if (constraints.priors.empty())
    problem.SetParameterBlockConstant(poses[0].data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = options.parameter_tolerance = 1e-16;
  options.gradient_tolerance = 1e-14;
  options.max_num_iterations = 500;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  result.chi2 = 2 * summary.final_cost;
  for (const auto& pose : poses) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = Eigen::Map<const Eigen::Quaterniond>(pose.data()).toRotationMatrix();
    T.translation() = Eigen::Map<const Eigen::Vector3d>(pose.data() + 4);
    result.poses.push_back(T);
  }
  for (const LinkSwitch& one : constraints.switches)
    result.switches.push_back(switches[one.link]);
  return result;
}

} // namespace pcl6d::test
