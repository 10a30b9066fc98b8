// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/slam6d/auto_parameters.h>

#include <algorithm>

namespace pcl6d {

Slam6DParameters
deriveParameters(const Slam6DOptions& options, const std::vector<Points>& scans)
{
  Slam6DParameters p;
  static_cast<ScanParameters&>(p) = deriveScanParameters(
      {options.min_range, options.max_range, options.voxel}, scans);
  p.max_distance = orDerived(
      options.max_distance,
      options.metric == Metric::kPoint
          ? derivedParameter(2 * p.voxel.value, "2 x voxel")
          : derivedParameter(1.7 * p.voxel.value, "1.7 x voxel, with normals"));
  p.max_distance_start =
      orDerived(options.max_distance_start,
                derivedParameter(std::max(12 * p.voxel.value, p.max_distance.value),
                                 "12 x voxel"));
  return p;
}

} // namespace pcl6d
