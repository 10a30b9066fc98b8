// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/median.h>
#include <pcl6d/slam6d/auto_parameters.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** The ends of a loop are three scans around a place each, and one between them. */
constexpr double kFewestScans = 4;
/** From farther than half the median range two scans see little of the same; where steps are
 * long, loops close at places some of them apart. So many loop distances are driven between
 * the ends. With steps of 1.25 m these are the 5 m and the 20 scans of the papers (5.1.2). */
constexpr double kLoopRanges = 0.5, kLoopSteps = 4, kLoopDistances = 5;
/** Of a loop: what relaxation asks of each link, and what JFR 2007 asks of a loop. */
constexpr double kFewestPairs = 20, kMostPairs = 250;
} // namespace

Slam6DParameters
deriveParameters(const Slam6DOptions& options, const std::vector<Points>& scans)
{
  Slam6DParameters p;
  static_cast<ScanParameters&>(p) = deriveScanParameters(
      {options.min_range, options.max_range, options.voxel, options.line_spacing},
      scans);
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

void
deriveLoopParameters(const Slam6DOptions& options,
                     const std::vector<ScanResult>& scans,
                     Slam6DParameters& p)
{
  std::vector<double> steps, points;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    points.push_back(static_cast<double>(scans[i].reduced));
    if (i > 0)
      steps.push_back((scans[i].T_world_scan.translation() -
                       scans[i - 1].T_world_scan.translation())
                          .norm());
  }
  const double step = upperMedian(steps);
  const double of_range = kLoopRanges * p.median_range, of_steps = kLoopSteps * step;
  p.loop_distance =
      orDerived(options.loop_distance,
                derivedParameter(std::max({of_range, of_steps, p.voxel.value}),
                                 "larger of half the median range and 4 median steps"));
  p.link_distance =
      orDerived(options.link_distance,
                derivedParameter(1.5 * p.loop_distance.value, "1.5 x loop-distance"));
  const double away = kLoopDistances * p.loop_distance.value;
  const bool has_way = step * static_cast<double>(scans.size()) > away;
  p.loop_gap = orDerived(
      options.loop_gap,
      has_way ? derivedParameter(std::ceil(std::max(kFewestScans, away / step)),
                                 "drives 5 x loop-distance meanwhile")
              : derivedParameter(std::max<double>(kFewestScans, scans.size()),
                                 "the way is shorter than 5 x loop-distance"));
  p.loop_pairs = orDerived(
      options.loop_pairs,
      derivedParameter(
          std::floor(std::clamp(0.05 * upperMedian(points), kFewestPairs, kMostPairs)),
          "5 % of the reduced points of a scan, at most 250"));
}

} // namespace pcl6d
