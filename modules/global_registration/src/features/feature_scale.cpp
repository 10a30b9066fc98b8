// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/median.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/filters/scan_parameters.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/global_registration/feature_scale.h>
#include <pcl6d/search/point_tree.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** [voxels] As in alignByFeatures() and PreparedScans. */
constexpr double kNormalVoxels = 3, kFeatureVoxels = 7;

/** Largest descriptor, relative to the spread of a cloud (half of the points lie within). */
constexpr double kMostOfSpread = 0.5;

/** From this number of neighbours a plane is accurate to a third of their noise. The distance
 * to the neighbours is measured at 500 points, evenly chosen. */
constexpr std::size_t kReachNeighbours = 10, kReachPoints = 500;

/** \return [m] the radius in which half of the points have enough neighbours */
double
medianReach(const Points& points)
{
  const PointTree tree(points, 1);
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kReachPoints);
  std::vector<double> reach;
  for (std::size_t i = 0; i < points.size(); i += stride)
    reach.push_back(std::sqrt(static_cast<double>(
        tree.nearestK(points[i], kReachNeighbours + 1).back().distance_sq)));
  return upperMedian(reach);
}
} // namespace

std::vector<FeatureScale>
estimateFeatureScales(const Points& points, std::size_t count)
{
  require(count > 0, "count", count, "> 0");
  const ScanParameters parameters = deriveScanParameters({}, {points});
  const Points seen =
      gateByRange(points, parameters.min_range.value, parameters.max_range.value);
  const double size = medianSpread(seen);
  std::vector<FeatureScale> scales;
  ReductionOptions reduction;
  reduction.voxel = parameters.voxel.value;
  for (std::size_t k = 0; k < count && size > 0; ++k, reduction.voxel *= 2) {
    FeatureScale scale;
    scale.voxel = reduction.voxel;
    scale.normal_radius = std::max(kNormalVoxels * scale.voxel,
                                   medianReach(reducePoints(seen, reduction)));
    scale.feature_radius = kFeatureVoxels / kNormalVoxels * scale.normal_radius;
    scale.why = parameters.voxel.why;
    if (k > 0 && !(scale.feature_radius < kMostOfSpread * size))
      break;
    scales.push_back(scale);
  }
  return scales;
}

} // namespace pcl6d
