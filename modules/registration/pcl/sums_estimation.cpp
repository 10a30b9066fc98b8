// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/registration/pcl/sums_estimation.h>

#include <cmath>
#include <limits>
#include <string>

namespace pcl6d {

void
throwUnlessOk(const RigidEstimate& estimate, std::size_t num_pairs, const char* needs)
{
  if (estimate.status == Status::kOk)
    return;
  throw ComputeFailed("no unique rigid motion from " + std::to_string(num_pairs) +
                      " pairs (" + toString(estimate.status) + "); " + needs);
}

void
requireSameSize(std::size_t num_source, std::size_t num_target)
{
  if (num_source != num_target)
    throw BadArgument("source has " + std::to_string(num_source) + " points, target " +
                      std::to_string(num_target) + ", but pairs need equal numbers");
}

bool
isFinal(const PlaneSums& sums, const Eigen::Isometry3d& step)
{
  constexpr double kAtRest = 1e-10;
  const Eigen::Vector3d& centroid = sums.mean_source;
  const double rounding =
      64 * std::numeric_limits<double>::epsilon() * centroid.cwiseAbs().sum();
  const double spread = std::sqrt(sums.sourceSq() / sums.weight);
  return rotationAngle(step.linear()) <= kAtRest &&
         (step * centroid - centroid).norm() <= kAtRest * spread + rounding;
}

PCL6D_DEFINE_PAIR_INSTANCES(SumsEstimation)
} // namespace pcl6d
