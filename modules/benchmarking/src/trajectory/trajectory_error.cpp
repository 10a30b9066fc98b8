// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/pose_pairs.h"

#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/benchmarking/trajectory_resampling.h>
#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/rotation.h>

#include <cmath>

namespace pcl6d {
using namespace benchmarking;

namespace {
ErrorStatistics
statisticsOf(const std::vector<PoseError>& errors, double PoseError::*kind)
{
  std::vector<double> values;
  values.reserve(errors.size());
  for (const auto& error : errors)
    values.push_back(error.*kind);
  return errorStatistics(values);
}

using Columns = Eigen::Matrix3Xd;

/** Rotation R of the centred positions d onto m by the SVD of S = sum d m^T.
 * \return false: the positions do not determine a rotation */
bool
rotationBetween(const Columns& d, const Columns& m, Eigen::Matrix3d& R)
{
  const auto [U, s, V] = singularValues(d * m.transpose());
  // Below this spread a set is a point up to rounding; s is the product of two spreads.
  constexpr double kPoint = 1e-18; // [m^2], per pair
  const bool mirrored = (V * U.transpose()).determinant() < 0;
  const auto count = static_cast<double>(d.cols());
  if (d.squaredNorm() <= kPoint * count || m.squaredNorm() <= kPoint * count ||
      s(1) <= 1e-9 * s(0) || (mirrored && s(1) - s(2) <= 1e-9 * s(0)))
    return false;
  const Eigen::Vector3d signs(1, 1, mirrored ? -1 : 1);
  R = V * signs.asDiagonal() * U.transpose();
  return true;
}
} // namespace

PoseError
poseError(const Eigen::Isometry3d& estimate, const Eigen::Isometry3d& reference)
{
  const Eigen::Vector3d difference = estimate.translation() - reference.translation();
  const Eigen::Quaterniond q(
      Eigen::Matrix3d(reference.linear().transpose() * estimate.linear()));
  PoseError error;
  error.position = difference.norm();
  error.orientation = 2 * portableAtan2(q.vec().norm(), std::abs(q.w()));
  error.position_2d = difference.head<2>().norm();
  error.yaw = std::abs(wrapAngle(eulerFromRotation(estimate.linear()).yaw -
                                 eulerFromRotation(reference.linear()).yaw));
  return error;
}

TrajectoryErrors
trajectoryErrors(const Trajectory& estimate,
                 const Trajectory& reference,
                 const std::vector<PosePair>& pairs,
                 const Eigen::Isometry3d& T_reference_estimate)
{
  checkPairs(estimate, reference, pairs);
  TrajectoryErrors errors;
  errors.poses.reserve(pairs.size());
  for (const auto& pair : pairs)
    errors.poses.push_back(
        poseError(T_reference_estimate * estimate.poses[pair.estimate],
                  reference.poses[pair.reference]));
  errors.position = statisticsOf(errors.poses, &PoseError::position);
  errors.orientation = statisticsOf(errors.poses, &PoseError::orientation);
  errors.position_2d = statisticsOf(errors.poses, &PoseError::position_2d);
  errors.yaw = statisticsOf(errors.poses, &PoseError::yaw);
  return errors;
}

RigidEstimate
alignPositions(const Trajectory& estimate,
               const Trajectory& reference,
               const std::vector<PosePair>& pairs)
{
  checkPairs(estimate, reference, pairs);
  RigidEstimate alignment;
  if (pairs.empty())
    return alignment;
  Columns d(3, pairs.size()), m(3, pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    d.col(column) = estimate.poses[pairs[i].estimate].translation();
    m.col(column) = reference.poses[pairs[i].reference].translation();
  }
  const Eigen::Vector3d c_d = d.rowwise().mean(), c_m = m.rowwise().mean();
  d.colwise() -= c_d;
  m.colwise() -= c_m;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (pairs.size() >= 3)
    alignment.status = rotationBetween(d, m, R) ? Status::kOk : Status::kRankDeficient;
  alignment.transform.linear() = R;
  alignment.transform.translation() = c_m - R * c_d;
  return alignment;
}

double
pathLength(const Trajectory& trajectory)
{
  double length = 0;
  for (std::size_t i = 1; i < trajectory.poses.size(); ++i)
    length +=
        (trajectory.poses[i].translation() - trajectory.poses[i - 1].translation())
            .norm();
  return length;
}

namespace {
std::vector<Revisit>
revisitsFor(const Trajectory& reference,
            const std::vector<PosePair>& pairs,
            const TrajectoryEvaluationOptions& options)
{
  if (!options.loops)
    return findRevisits(reference, pairs, options.revisits);
  if (options.interpolation_gap)
    throw BadArgument("loops are given by poses of the reference, but interpolation "
                      "replaces these poses: give loops or interpolate");
  return revisitsOf(*options.loops, pairs);
}
} // namespace

TrajectoryEvaluation
evaluateTrajectory(const Trajectory& estimate,
                   const Trajectory& reference,
                   const TrajectoryEvaluationOptions& options)
{
  if (options.interpolation_gap && estimate.stamps.empty())
    throw BadArgument("the estimate has no time stamps, needed for interpolation");
  TrajectoryEvaluation evaluation;
  evaluation.path_length = pathLength(reference);
  const Trajectory compared =
      options.interpolation_gap
          ? resample(reference, estimate.stamps, *options.interpolation_gap)
          : reference;
  if (compared.poses.empty() && !reference.poses.empty())
    throw ComputeFailed("no pose of the estimate lies between two poses of the "
                        "reference that are close enough in time");
  evaluation.matching = matchPoses(estimate, compared, options.matching);
  const auto& pairs = evaluation.matching.pairs;
  evaluation.without_alignment = trajectoryErrors(estimate, compared, pairs);
  evaluation.alignment = alignPositions(estimate, compared, pairs);
  evaluation.with_alignment =
      trajectoryErrors(estimate, compared, pairs, evaluation.alignment.transform);
  evaluation.steps = stepErrors(estimate, compared, pairs);
  evaluation.drift = driftErrors(estimate, compared, pairs, options.lengths);
  evaluation.loops = loopClosureErrors(
      estimate, compared, pairs, revisitsFor(compared, pairs, options));
  evaluation.length_ratios =
      lengthRatioErrors(poseDistances(estimate, compared, pairs));
  return evaluation;
}

} // namespace pcl6d
