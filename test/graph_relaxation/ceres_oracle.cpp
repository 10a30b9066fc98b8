// SPDX-License-Identifier: BSD-3-Clause
#include "ceres_oracle.h"

#include <Eigen/Cholesky>

#include <array>
#include <ceres/ceres.h>
#include <ceres/rotation.h>

namespace pcl6d::test {

namespace {
/** Angle-axis, then translation. */
using Block = std::array<double, 6>;

struct PairCost {
  Eigen::Vector3d u, v;
  Eigen::Matrix3d root; ///< of factor times weight times norm

  template <typename T>
  bool
  operator()(const T* a, const T* b, T* residual) const
  {
    const T from[3] = {T(u.x()), T(u.y()), T(u.z())};
    const T to[3] = {T(v.x()), T(v.y()), T(v.z())};
    T pa[3], pb[3], z[3];
    ceres::AngleAxisRotatePoint(a, from, pa);
    ceres::AngleAxisRotatePoint(b, to, pb);
    for (int i = 0; i < 3; ++i)
      z[i] = pa[i] + a[3 + i] - pb[i] - b[3 + i];
    for (int i = 0; i < 3; ++i)
      residual[i] = root(i, 0) * z[0] + root(i, 1) * z[1] + root(i, 2) * z[2];
    return true;
  }
};

/** The logarithm of M^-1 A^-1 B, spelled out. */
struct MeasuredCost {
  Eigen::Isometry3d measured;
  Eigen::Matrix<double, 6, 6> root;

  template <typename T>
  bool
  operator()(const T* a, const T* b, T* residual) const
  {
    using Vector3 = Eigen::Matrix<T, 3, 1>;
    using Matrix3 = Eigen::Matrix<T, 3, 3>; // Ceres writes columns first, as Eigen does
    Matrix3 Ra, Rb;
    ceres::AngleAxisToRotationMatrix(a, Ra.data());
    ceres::AngleAxisToRotationMatrix(b, Rb.data());
    const Vector3 ta(a[3], a[4], a[5]), tb(b[3], b[4], b[5]);
    const Matrix3 Rm = measured.linear().cast<T>();
    const Vector3 tm = measured.translation().cast<T>();
    const Matrix3 R = Rm.transpose() * Ra.transpose() * Rb;
    const Vector3 t = Rm.transpose() * (Ra.transpose() * (tb - ta) - tm);
    Vector3 x;
    ceres::RotationMatrixToAngleAxis(R.data(), x.data());
    const T n2 = x.squaredNorm();
    T q = T(1.0 / 12) + n2 / 720.0 + n2 * n2 / 30240.0; // small closing errors
    if (n2 > T(1e-3)) {
      const T n = sqrt(n2);
      q = (1.0 - 0.5 * n * cos(0.5 * n) / sin(0.5 * n)) / n2;
    }
    Eigen::Matrix<T, 6, 1> e;
    e << t - x.cross(t) * T(0.5) + x.cross(x.cross(t)) * q, x;
    Eigen::Map<Eigen::Matrix<T, 6, 1>> out(residual);
    out = root.cast<T>() * e;
    return true;
  }
};

template <typename Matrix>
Matrix
rootOf(const Matrix& symmetric)
{
  return symmetric.llt().matrixU();
}

Block
blockOf(const Eigen::Isometry3d& pose, const Eigen::Vector3d& origin)
{
  Block block;
  const Eigen::Matrix3d R = pose.linear();
  ceres::RotationMatrixToAngleAxis(R.data(), block.data());
  Eigen::Map<Eigen::Vector3d> t(&block[3]);
  t = pose.translation() - origin;
  return block;
}

Eigen::Isometry3d
poseOf(const Block& block, const Eigen::Vector3d& origin)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Eigen::Matrix3d R;
  ceres::AngleAxisToRotationMatrix(block.data(), R.data());
  pose.linear() = R;
  pose.translation() = Eigen::Map<const Eigen::Vector3d>(&block[3]) + origin;
  return pose;
}

void
addPairs(ceres::Problem& problem,
         std::vector<Block>& blocks,
         const LinkPairs& link,
         double factor)
{
  for (std::size_t k = 0; k < link.points_from.size(); ++k) {
    const double weight = factor * (link.weights.empty() ? 1 : link.weights[k]);
    const Eigen::Matrix3d N =
        link.norms.empty() ? Eigen::Matrix3d::Identity() : link.norms[k];
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<PairCost, 3, 6, 6>(
                                 new PairCost{link.points_from[k].cast<double>(),
                                              link.points_to[k].cast<double>(),
                                              rootOf<Eigen::Matrix3d>(weight * N)}),
                             nullptr,
                             blocks[link.from].data(),
                             blocks[link.to].data());
  }
}
} // namespace

Poses
ceresOptimum(const Poses& start,
             const std::vector<LinkPairs>& links,
             const std::vector<double>& factors,
             const std::vector<PoseLink>& measured)
{
  const Eigen::Vector3d origin = start.front().translation();
  std::vector<Block> blocks;
  for (const auto& pose : start)
    blocks.push_back(blockOf(pose, origin));
  ceres::Problem problem;
  for (std::size_t l = 0; l < links.size(); ++l)
    addPairs(problem, blocks, links[l], factors.empty() ? 1 : factors[l]);
  for (const PoseLink& link : measured)
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<MeasuredCost, 6, 6, 6>(new MeasuredCost{
            link.T_from_to, rootOf<Eigen::Matrix<double, 6, 6>>(link.information)}),
        nullptr,
        blocks[link.from].data(),
        blocks[link.to].data());
  problem.SetParameterBlockConstant(blocks.front().data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = options.parameter_tolerance = 1e-16;
  options.gradient_tolerance = 1e-14;
  options.max_num_iterations = 200;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  Poses poses;
  for (const auto& block : blocks)
    poses.push_back(poseOf(block, origin));
  return poses;
}

} // namespace pcl6d::test
