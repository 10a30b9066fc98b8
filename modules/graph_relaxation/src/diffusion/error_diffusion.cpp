// SPDX-License-Identifier: BSD-3-Clause
#include "diffusion/loop_checks.h"

#include <pcl6d/common/name_table.h>
#include <pcl6d/common/pose.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace pcl6d {
using namespace graph_relaxation;

namespace {
constexpr double kHalfTurn = M_PI - 1e-3; ///< [rad] beyond, the axis may be either way
constexpr Named<LoopClosing> kMethods[] = {{LoopClosing::kElch, "elch"},
                                           {LoopClosing::kUniform, "uniform"},
                                           {LoopClosing::kPath, "path"},
                                           {LoopClosing::kNone, "none"}};

/** \return weights that rise with the steps from first to last; uniform if every step is 0
 * \param[in] step of the i-th pose to the next */
template <typename Step>
std::vector<double>
risingWeights(std::size_t num_poses, std::size_t first, std::size_t last, Step step)
{
  requireLoop(num_poses, first, last);
  const std::size_t low = std::min(first, last), high = std::max(first, last);
  std::vector<double> way(num_poses, 0);
  for (std::size_t i = low; i < high; ++i)
    way[i + 1] = way[i] + step(i);
  const double length = way[high];
  std::vector<double> weights(num_poses);
  for (std::size_t i = 0; i < num_poses; ++i) {
    double w = i <= low ? 0 : i >= high ? 1 : 0;
    if (i > low && i < high)
      w = length > 0 ? way[i] / length : static_cast<double>(i - low) / (high - low);
    weights[i] = first < last ? w : 1 - w;
  }
  return weights;
}

/** \return the pose with an exact rotation, where a file has lost digits */
Eigen::Isometry3d
trulyRigid(const Eigen::Isometry3d& pose)
{
  constexpr double kRounding = 1e-12;
  Eigen::Isometry3d rigid = pose;
  if (!isRigid(pose, kRounding))
    rigid.linear() = nearestRotation(pose.linear());
  return rigid;
}

/** \return a power of two that scales the positions to about 1, so that neither squared
 * distances nor their sum overflow */
double
scaleOf(const std::vector<Eigen::Isometry3d>& poses)
{
  constexpr int kLargestExponent = 1000;
  double largest = 0;
  for (const auto& pose : poses)
    largest = std::max(largest, pose.translation().cwiseAbs().maxCoeff());
  if (largest == 0)
    return 1;
  const int exponent =
      std::clamp(std::ilogb(largest), -kLargestExponent, kLargestExponent);
  return std::ldexp(1.0, -exponent);
}

std::vector<PerDimension>
inAllDimensions(const std::vector<double>& weights)
{
  std::vector<PerDimension> all;
  for (const double w : weights)
    all.push_back(PerDimension::Constant(w));
  return all;
}

/** \return the weights of kElch; empty if first and last are not joined */
std::vector<PerDimension>
elchInAllDimensions(std::size_t num_poses,
                    const std::vector<LoopEdge>& edges,
                    const Loop& loop,
                    bool per_axis)
{
  std::vector<PerDimension> all;
  const auto weigh = [&](auto&& costOf, std::initializer_list<int> dimensions) {
    std::vector<WeightedEdge> scalar;
    for (const auto& edge : edges)
      scalar.push_back({edge.a, edge.b, costOf(edge.cost)});
    const auto weights = elchWeights(num_poses, scalar, loop.first, loop.last);
    all.resize(weights.size());
    for (std::size_t i = 0; i < weights.size(); ++i)
      for (const int k : dimensions)
        all[i][k] = weights[i];
  };
  if (per_axis)
    for (int k = 0; k < 3; ++k)
      weigh([k](const PerDimension& cost) { return cost[k]; }, {k});
  else // thirds first: the sum of large costs may overflow
    weigh([](const PerDimension& cost) { return (cost.head<3>() / 3).sum(); },
          {0, 1, 2});
  weigh([](const PerDimension& cost) { return cost[3]; }, {3});
  return all;
}

/** Computes the weights and the resulting status. */
void
findWeights(const std::vector<Eigen::Isometry3d>& poses,
            const std::vector<LoopEdge>& edges,
            const Loop& loop,
            const ErrorDiffusionOptions& options,
            ErrorDiffusionResult& result)
{
  const std::size_t n = poses.size();
  switch (options.method) {
  case LoopClosing::kNone:
    result.weights.assign(n, PerDimension::Zero());
    return;
  case LoopClosing::kPath:
    result.weights = inAllDimensions(pathWeights(poses, loop.first, loop.last));
    return;
  case LoopClosing::kElch:
    result.weights = elchInAllDimensions(n, edges, loop, options.per_axis);
    if (!result.weights.empty())
      return;
    result.status = Status::kRankDeficient;
    break;
  case LoopClosing::kUniform:
    break;
  }
  result.weights = inAllDimensions(uniformWeights(n, loop.first, loop.last));
}

/** Moves each pose by its share of the motion of the last.
 * \return false: the values overflow, and no pose has moved */
bool
applyWeights(const Loop& loop,
             const Eigen::Vector3d& closing_rotation,
             ErrorDiffusionResult& result)
{
  std::vector<Eigen::Isometry3d> poses = result.poses;
  const Eigen::Vector3d shift =
      loop.corrected_last.translation() - poses[loop.last].translation();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const PerDimension& w = result.weights[i];
    Eigen::Isometry3d& pose = poses[i];
    if (!w.head<3>().isZero(0)) // else even the sign of a zero stays
      pose.translation() += w.head<3>().cwiseProduct(shift);
    if (w[3] != 0)
      pose.linear() = rotationFromVector(w[3] * closing_rotation) * pose.linear();
  }
  poses[loop.last] = trulyRigid(loop.corrected_last);
  const bool finite = std::all_of(poses.begin(), poses.end(), [](const auto& pose) {
    return pose.matrix().allFinite();
  });
  if (finite)
    result.poses = std::move(poses);
  return finite;
}
} // namespace

std::vector<std::string>
loopClosingNames()
{
  return namesOf(kMethods);
}

LoopClosing
loopClosingFromName(const std::string& name)
{
  return fromName(kMethods, "loop-closing", name);
}

const char*
toString(LoopClosing method)
{
  return nameOf(kMethods, method);
}

PerDimension
costOfCovariance(const Eigen::Matrix<double, 6, 6>& covariance)
{
  require(covariance.allFinite() && (covariance.diagonal().array() >= 0).all(),
          "variances of an edge",
          covariance.diagonal().transpose(),
          "finite and >= 0: the covariances must be finite");
  PerDimension cost;
  cost << covariance.diagonal().head<3>(), covariance.diagonal().tail<3>().sum();
  return cost;
}

std::vector<double>
uniformWeights(std::size_t num_poses, std::size_t first, std::size_t last)
{
  return risingWeights(num_poses, first, last, [](std::size_t) { return 0.0; });
}

std::vector<double>
pathWeights(const std::vector<Eigen::Isometry3d>& poses,
            std::size_t first,
            std::size_t last)
{
  requirePoses(poses);
  const double scale = scaleOf(poses);
  return risingWeights(poses.size(), first, last, [&](std::size_t i) {
    return (scale * poses[i + 1].translation() - scale * poses[i].translation()).norm();
  });
}

ErrorDiffusionResult
closeLoop(const std::vector<Eigen::Isometry3d>& poses,
          const std::vector<LoopEdge>& edges,
          const Loop& loop,
          const ErrorDiffusionOptions& options)
{
  requireInput(poses, edges, {loop});
  ErrorDiffusionResult result;
  result.poses = poses;
  findWeights(poses, edges, loop, options, result);
  const Eigen::Isometry3d& last = poses[loop.last];
  if (options.method == LoopClosing::kNone ||
      last.matrix() == loop.corrected_last.matrix())
    return result;
  const Eigen::Vector3d rotation =
      rotationVector(loop.corrected_last.linear() * last.linear().transpose());
  if (!(rotation.norm() < kHalfTurn) || !applyWeights(loop, rotation, result))
    result.status = Status::kDiverged;
  return result;
}

ErrorDiffusionResult
closeLoops(const std::vector<Eigen::Isometry3d>& poses,
           std::vector<LoopEdge> edges,
           const std::vector<Loop>& loops,
           const ErrorDiffusionOptions& options)
{
  requireInput(poses, edges, loops);
  ErrorDiffusionResult result;
  result.poses = poses;
  result.weights.assign(poses.size(), PerDimension::Zero());
  for (const auto& given : loops) {
    Loop loop = given;
    if (result.poses[loop.first].matrix() != poses[loop.first].matrix())
      loop.corrected_last =
          result.poses[loop.first] * poses[loop.first].inverse() * given.corrected_last;
    if (!loop.corrected_last.matrix().allFinite()) {
      result.status = Status::kDiverged;
      continue;
    }
    const Status before = result.status;
    result = closeLoop(result.poses, edges, loop, options);
    if (result.status != Status::kDiverged)
      edges.push_back({loop.first, loop.last, loop.cost});
    if (before == Status::kDiverged || result.status == Status::kOk)
      result.status = before;
  }
  return result;
}

} // namespace pcl6d
