// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/feature_scan.h"

#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/voxel_reduction.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d::registration {

namespace {
constexpr std::size_t kNormalNeighbours = 20; // within 2.5 voxels on a plane

Points
withoutRepeats(Points points)
{
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}
} // namespace

Points
measuredPoints(const Points& scan)
{
  const double nothing =
      noReturnRange(scan).value_or(std::numeric_limits<double>::infinity());
  const double median = medianRange(gateByRange(scan, 0, 0.999 * nothing));
  // A sensible voxel is not below median / 60; 2^20 voxels of this size reach
  // 17000 medians.
  return gateByRange(
      scan, std::min(0.2, 0.1 * median), std::min(0.999 * nothing, 1e4 * median));
}

double
distinctSpacing(const Points& points)
{
  return medianSpacing(withoutRepeats(points));
}

double
featureVoxel(const Points& measured, std::size_t max_points)
{
  const double range = medianRange(measured);
  double voxel = std::max(2.5 * distinctSpacing(measured), range / 60);
  if (!(voxel > 0))
    return 0;
  for (int i = 0; i < 4; ++i) { // surfaces: their number falls with the square
    const auto count = static_cast<double>(VoxelGroups(measured, voxel).size());
    if (count <= 1.1 * static_cast<double>(max_points))
      break;
    voxel *= std::sqrt(count / static_cast<double>(max_points));
  }
  return voxel;
}

FeatureScan
makeFeatureScan(const Points& measured, double voxel, unsigned int num_threads)
{
  FeatureScan scan;
  ReductionOptions reduction;
  reduction.voxel = voxel;
  scan.points = reducePoints(measured, reduction);
  scan.tree = PointTree(scan.points, num_threads);
  scan.normals =
      estimateNormals(scan.points, scan.tree, kNormalNeighbours, num_threads);
  return scan;
}

} // namespace pcl6d::registration
