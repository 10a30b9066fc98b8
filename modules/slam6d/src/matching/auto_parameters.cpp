// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/median.h>
#include <pcl6d/filters/planar_scan.h>
#include <pcl6d/filters/range_statistics.h>
#include <pcl6d/registration/reduced_scans.h>
#include <pcl6d/slam6d/auto_parameters.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** Three scans around a position at each end of a loop, and a scan between both ends. */
constexpr double kFewestScans = 4;
/** Beyond half the median range two scans overlap little. With long steps, loops close between
 * scans a few steps apart. The distance driven between the ends is kLoopDistances loop distances.
 * With steps of 1.25 m the result is the 5 m and the 20 scans of the papers (5.1.2). */
constexpr double kLoopRanges = 0.5, kLoopSteps = 4, kLoopDistances = 5;
/** Pairs of a loop: the minimum that relaxation requires of a link, and JFR 2007 of a loop. */
constexpr double kFewestPairs = 20, kMostPairs = 250;
/** The row spacing of raised scans is twice the point spacing, which keeps the nearest neighbours
 * of a point in its own row. deriveScanParameters() then makes a voxel 1.3 row spacings wide, but
 * at least a 60th of the median range. */
constexpr double kRowsOfSpacing = 2, kRowsOfVoxel = 1 / 1.3, kVoxelsOfRange = 60;

/** \return the row spacing of raised scans; 0 if most scans are not planar
 * \param[in] seen points within the range gate */
Parameter
planarRows(const Slam6DOptions& options, const std::vector<Points>& seen)
{
  if (options.planar_rows)
    return {*options.planar_rows, true, ""};
  std::vector<double> ranges, spacings;
  for (const Points& scan : seen)
    if (isPlanarScan(scan)) {
      ranges.push_back(medianRange(scan));
      spacings.push_back(medianSpacing(scan));
    }
  if (2 * ranges.size() <= seen.size())
    return {};
  const double voxel = options.voxel.value_or(upperMedian(ranges) / kVoxelsOfRange);
  return derivedParameter(
      std::max(kRowsOfSpacing * upperMedian(spacings), kRowsOfVoxel * voxel),
      "2D scans, registered in the plane of the first scan: x, y and yaw");
}

/** \return range gate and reduction; for planar scans, the gate is derived from the measured points
 * and the reduction from the raised walls */
Slam6DParameters
scanParametersOf(const Slam6DOptions& options, const std::vector<Points>& scans)
{
  const ScanParameterOptions given = {
      options.min_range, options.max_range, options.voxel, options.line_spacing};
  Slam6DParameters p;
  static_cast<ScanParameters&>(p) = deriveScanParameters(given, scans);
  if (options.planar_rows ? *options.planar_rows == 0
                          : std::none_of(scans.begin(), scans.end(), isPlanarScan)) {
    p.planar_rows.given = options.planar_rows.has_value();
    return p;
  }
  std::vector<Points> seen;
  for (const Points& scan : scans)
    seen.push_back(gateByRange(scan, p.min_range.value, p.max_range.value));
  p.planar_rows = planarRows(options, seen);
  if (!(p.planar_rows.value > 0))
    return p;
  for (Points& scan : seen)
    if (isPlanarScan(scan))
      scan = raisedPlanarScan(scan, p.planar_rows.value);
  const ScanParameters gate = p;
  static_cast<ScanParameters&>(p) = deriveScanParameters(given, seen);
  p.min_range = gate.min_range;
  p.max_range = gate.max_range;
  return p;
}
} // namespace

Slam6DParameters
deriveParameters(const Slam6DOptions& options, const std::vector<Points>& scans)
{
  Slam6DParameters p = scanParametersOf(options, scans);
  p.max_distance =
      orDerived(options.max_distance,
                options.metric == Metric::kPoint
                    ? derivedParameter(kPointPairVoxels * p.voxel.value, "2 x voxel")
                    : derivedParameter(kPlanePairVoxels * p.voxel.value,
                                       "1.7 x voxel, with normals"));
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
