// SPDX-License-Identifier: BSD-3-Clause
#include "plane_patch.h"

#include <pcl6d/benchmarking/plane_thickness.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl6d {

namespace {
/** The points of one plane, and what they add to the scans they came from. */
struct Collected {
  ThickPlane plane;
  std::vector<double> sum_sq; ///< [m^2] per scan
  std::vector<std::size_t> count;
};

void
checkMap(const MapPoints& map, std::size_t num_scans)
{
  require(map.normals.size() == map.points.size(),
          "normals",
          map.normals.size(),
          "one per point");
  require(map.scans.size() == map.points.size(),
          "scans",
          map.scans.size(),
          "one per point");
  for (const std::uint32_t scan : map.scans)
    require(scan < num_scans, "scan of a point", scan, "one of the scans");
}

/** Largest first, without those that show the surface of a larger one. */
std::vector<PlanePatch>
differentPatches(const std::vector<PlaneSegment>& planes,
                 const PlaneThicknessOptions& options)
{
  std::vector<const PlaneSegment*> by_area;
  for (const PlaneSegment& segment : planes)
    if (segment.plane.area >= options.min_area && segment.plane.hull.size() >= 3)
      by_area.push_back(&segment);
  std::stable_sort(by_area.begin(), by_area.end(), [](const auto* a, const auto* b) {
    return a->plane.area > b->plane.area;
  });
  std::vector<PlanePatch> patches;
  for (const PlaneSegment* segment : by_area) {
    if (patches.size() == options.max_planes)
      break;
    const PlanePatch patch(*segment, options.gate, options.max_angle);
    const bool known =
        std::any_of(patches.begin(), patches.end(), [&](const PlanePatch& larger) {
          return larger.covers(patch);
        });
    if (!known)
      patches.push_back(patch);
  }
  return patches;
}

Collected
collect(PlanePatch patch,
        const MapPoints& map,
        std::size_t num_scans,
        const PlaneThicknessOptions& options)
{
  std::vector<std::size_t> members = patch.membersOf(map);
  for (int round = 0; round < 2 && members.size() >= options.min_points; ++round) {
    patch.fit(map.points, members);
    members = patch.membersOf(map);
  }
  Collected result;
  result.sum_sq.assign(num_scans, 0);
  result.count.assign(num_scans, 0);
  if (members.size() < options.min_points)
    return result;
  double sum_sq = 0;
  for (const std::size_t i : members) {
    const double distance = patch.distanceOf(map.points[i]);
    sum_sq += distance * distance;
    result.sum_sq[map.scans[i]] += distance * distance;
    ++result.count[map.scans[i]];
  }
  ThickPlane& thick = result.plane;
  thick.plane = patch.plane();
  thick.plane.inliers = members.size();
  thick.thickness = std::sqrt(sum_sq / static_cast<double>(members.size()));
  thick.plane.rms = thick.thickness;
  for (const std::size_t count : result.count)
    thick.scans += count > 0;
  return result;
}

PlaneThickness
summedUp(const std::vector<Collected>& collected, std::size_t num_scans)
{
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const auto rmsOf = [&](double sum_sq, std::size_t count) {
    return count > 0 ? std::sqrt(sum_sq / static_cast<double>(count)) : nothing;
  };
  std::vector<double> sum_sq(num_scans, 0), thicknesses;
  std::vector<std::size_t> count(num_scans, 0);
  PlaneThickness result;
  double all_sq = 0;
  std::size_t all = 0;
  for (const Collected& one : collected) {
    if (one.plane.scans < 2)
      continue;
    result.planes.push_back(one.plane);
    thicknesses.push_back(one.plane.thickness);
    for (std::size_t scan = 0; scan < num_scans; ++scan) {
      sum_sq[scan] += one.sum_sq[scan];
      count[scan] += one.count[scan];
    }
  }
  for (std::size_t scan = 0; scan < num_scans; ++scan) {
    result.scans.push_back(rmsOf(sum_sq[scan], count[scan]));
    all_sq += sum_sq[scan];
    all += count[scan];
  }
  result.rms = rmsOf(all_sq, all);
  result.median = thicknesses.empty() ? nothing : upperMedian(thicknesses);
  return result;
}
} // namespace

void
PlaneThicknessOptions::validate() const
{
  require(std::isfinite(gate) && gate > 0, "gate", gate, "finite and > 0");
  require(
      max_angle > 0 && max_angle < M_PI / 2, "max_angle", max_angle, "in (0, pi/2)");
  require(std::isfinite(min_area) && min_area >= 0,
          "min_area",
          min_area,
          "finite and >= 0");
  require(min_points >= 4, "min_points", min_points, ">= 4");
  require(max_planes >= 1, "max_planes", max_planes, ">= 1");
}

PlaneThickness
planeThickness(const std::vector<PlaneSegment>& planes,
               const MapPoints& map,
               std::size_t num_scans,
               const PlaneThicknessOptions& options)
{
  options.validate();
  checkMap(map, num_scans);
  const std::vector<PlanePatch> patches = differentPatches(planes, options);
  std::vector<Collected> collected(patches.size());
  parallelFor(patches.size(), options.num_threads, [&](std::size_t k) {
    collected[k] = collect(patches[k], map, num_scans, options);
  });
  return summedUp(collected, num_scans);
}

} // namespace pcl6d
