// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/registration/transformation_estimation_quaternion.h>

#include <string>

namespace pcl6d {

void
throwUnlessOk(const RigidEstimate& estimate, std::size_t num_pairs)
{
  if (estimate.status == Status::kOk)
    return;
  throw ComputeFailed("no unique rigid motion from " + std::to_string(num_pairs) +
                      " pairs (" + toString(estimate.status) +
                      "); at least 3 that are not on one line are needed");
}

void
requireSameSize(std::size_t num_source, std::size_t num_target)
{
  if (num_source != num_target)
    throw BadArgument("source has " + std::to_string(num_source) + " points, target " +
                      std::to_string(num_target) + ", but they must be pairs");
}

PCL6D_DEFINE_PAIR_INSTANCES(TransformationEstimationQuaternion)
} // namespace pcl6d
