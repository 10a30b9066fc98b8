// SPDX-License-Identifier: BSD-3-Clause
#include "targets/target_parts.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/voxel_numbers.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace pcl6d {
using namespace targets;

const char*
toString(TargetKind kind)
{
  return kind == TargetKind::kSphere ? "sphere" : "board";
}

std::string
toWords(const RejectedTarget& rejected)
{
  std::ostringstream text;
  const auto rounded = [&text](int digits) -> std::ostream& {
    return text << std::fixed << std::setprecision(digits);
  };
  switch (rejected.fault) {
  case TargetFault::kOtherDiameter:
    text << "its diameter is ";
    rounded(3) << rejected.measured << " m";
    break;
  case TargetFault::kMostlyHidden:
    text << "only ";
    rounded(0) << 100 * rejected.measured << " % of the visible side have points";
    break;
  case TargetFault::kGrazingAngle:
    text << "seen at ";
    rounded(0) << degrees(rejected.measured) << " deg, at most "
               << degrees(std::acos(kGrazing)) << " deg";
    break;
  case TargetFault::kSmallerBoard:
    text << "smaller than " << rejected.size << " m: near the border ";
    rounded(0) << 100 * rejected.measured
               << " % of the points have the colour of their quarter";
    break;
  }
  return text.str();
}

void
TargetOptions::validate() const
{
  for (const double diameter : sphere_diameters)
    require(std::isfinite(diameter) && diameter > 0,
            "sphere_diameter",
            diameter,
            "finite and > 0");
  for (const double size : board_sizes)
    require(std::isfinite(size) && size > 0, "board_size", size, "finite and > 0");
}

void
targets::addTarget(const FoundTarget& candidate,
                   const std::optional<MeasuredFault>& fault,
                   TargetSearch& search)
{
  if (fault)
    search.rejected.push_back({candidate.kind,
                               candidate.size,
                               candidate.centre,
                               fault->fault,
                               fault->measured});
  else
    search.found.push_back(candidate);
}

std::vector<std::size_t>
targets::pointsNear(const TargetScan& scan,
                    const Eigen::Vector3d& place,
                    double distance)
{
  std::vector<std::size_t> near;
  for (const Neighbour& n : scan.tree.withinRadius(
           place.cast<float>(), static_cast<float>(distance * distance)))
    near.push_back(static_cast<std::size_t>(n.index));
  std::sort(near.begin(), near.end());
  return near;
}

std::vector<std::size_t>
targets::seedsOf(const TargetScan& scan, double voxel)
{
  VoxelNumbers voxels;
  std::vector<std::size_t> seeds;
  for (std::size_t i = 0; i < scan.points.size(); ++i)
    if (voxels.add(voxelKey(scan.points[i], voxel)).second)
      seeds.push_back(i);
  return seeds;
}

namespace {
/** Of targets nearer to each other than half their size, keeps the target with more
 * points; a rejected target near a found target is dropped, too. */
void
keepBest(TargetSearch& search)
{
  auto& found = search.found;
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.points > b.points;
  });
  std::vector<FoundTarget> kept;
  const auto isAt = [](const auto& a, const auto& b) {
    return (a.centre - b.centre).norm() < 0.5 * std::max(a.size, b.size);
  };
  for (const FoundTarget& one : found)
    if (std::none_of(
            kept.begin(), kept.end(), [&](const auto& k) { return isAt(k, one); }))
      kept.push_back(one);
  std::stable_sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) {
    return a.centre.norm() < b.centre.norm();
  });
  found = std::move(kept);
  std::vector<RejectedTarget> rejected;
  for (const RejectedTarget& one : search.rejected) {
    const auto isHere = [&](const auto& other) { return isAt(other, one); };
    if (std::none_of(found.begin(), found.end(), isHere) &&
        std::none_of(rejected.begin(), rejected.end(), isHere))
      rejected.push_back(one);
  }
  search.rejected = std::move(rejected);
}
} // namespace

TargetSearch
findTargets(const Points& points,
            const std::vector<float>& intensity,
            const TargetOptions& options)
{
  options.validate();
  require(intensity.empty() || intensity.size() == points.size(),
          "intensity",
          intensity.size(),
          "empty or equal to the number of points");
  TargetScan scan;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite() || points[i].isZero(0))
      continue;
    scan.points.push_back(points[i]);
    if (!intensity.empty())
      scan.intensity.push_back(intensity[i]);
  }
  TargetSearch search;
  if (scan.points.empty())
    return search;
  scan.tree = PointTree(scan.points, options.num_threads);
  for (const double diameter : options.sphere_diameters)
    findSpheres(scan, diameter, options.num_threads, search);
  for (const double size : options.board_sizes)
    if (!scan.intensity.empty())
      findBoards(scan, size, options.num_threads, search);
  keepBest(search);
  return search;
}

} // namespace pcl6d
