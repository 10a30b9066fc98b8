// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "pair/place_matching.h"

#include <algorithm>

namespace pcl6d::global_registration {

IcpOptions
matchingOptions(double voxel, double start)
{
  IcpOptions options;
  options.metric = Metric::kGicp;
  options.gicp_epsilon = kReducedGicpEpsilon;
  options.facing_normals = true;
  options.max_distance = kMetVoxels * voxel;
  options.max_distance_start = std::max(start, options.max_distance);
  options.distance_decay = 0.75;
  options.shrinking_stride = 2;
  options.max_iterations = 40;
  options.translation_epsilon = 0.01 * voxel;
  options.rotation_epsilon = 1e-4;
  options.num_threads = 1;
  return options;
}

IcpOptions
fineOptions(double voxel, unsigned int num_threads)
{
  IcpOptions options = matchingOptions(voxel, 0);
  options.max_iterations = 100;
  options.translation_epsilon = 0.001 * voxel;
  options.rotation_epsilon = 1e-5;
  options.num_threads = num_threads;
  return options;
}

} // namespace pcl6d::global_registration
