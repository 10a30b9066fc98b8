// SPDX-License-Identifier: BSD-3-Clause
#include "matching/refined_match.h"

#include <algorithm>

namespace pcl6d::slam6d {

namespace {
/** Lines per voxel, at most, for a refinement. Voxels are 1.3 line spacings wide (kVoxelOfLines)
 * where lines decide; 1.5 allows for given voxels. Denser lines have 2 and more. */
constexpr double kMostLinesOfVoxel = 1.5;

/** Most refined matches rest after 7 iterations. Some never do: the weights change while a pair at
 * the largest distance comes and goes, and the pose moves by a thousandth of a voxel. */
constexpr int kRefiningIterations = 20;

/** \return whether no motion is open, and ICP has not failed */
bool
isFixed(const IcpResult& match)
{
  return (match.status == Status::kOk || match.status == Status::kMaxIterations) &&
         match.localizability && match.localizability->openDirections() == 0;
}

/** \return [m] mean distance of points from one pose to another */
double
meanMotion(const Points& points,
           const Eigen::Isometry3d& from,
           const Eigen::Isometry3d& to)
{
  double sum = 0;
  for (const Eigen::Vector3f& point : points)
    sum += (to * point.cast<double>() - from * point.cast<double>()).norm();
  return sum / static_cast<double>(points.size());
}
} // namespace

bool
areNormalsUncertain(double line_spacing, double voxel)
{
  return kMostLinesOfVoxel * line_spacing >= voxel;
}

bool
isRefined(const IcpOptions& options)
{
  return options.metric == Metric::kGicp && options.robust == RobustKernel::kNone;
}

void
refineMatch(const IcpTarget& target,
            const IcpSource& source,
            const IcpOptions& options,
            IcpResult& found)
{
  if (!isRefined(options) || found.status != Status::kOk || !isFixed(found))
    return;
  IcpOptions refining = options;
  refining.gicp_epsilon = std::min(options.gicp_epsilon, IcpOptions().gicp_epsilon);
  refining.robust = RobustKernel::kGemanMcClure;
  refining.max_distance_start = 0;
  refining.max_iterations = std::min(options.max_iterations, kRefiningIterations);
  const IcpResult refined = icp(target, source, found.T_target_source, refining);
  found.iterations += refined.iterations;
  if (isFixed(refined) &&
      meanMotion(*source.points, found.T_target_source, refined.T_target_source) <=
          options.max_distance)
    found.T_target_source = refined.T_target_source;
}

} // namespace pcl6d::slam6d
