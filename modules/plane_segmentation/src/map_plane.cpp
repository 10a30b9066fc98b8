// SPDX-License-Identifier: BSD-3-Clause
#include "map_plane.h"
#include "plane_outline.h"

#include <pcl6d/common/portable_math.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** Of a cell: points of neighbouring cells are at most so far apart. */
constexpr double kCellReach = 1.5;

void
insertAround(const Eigen::Vector3f& place,
             double coarse,
             std::unordered_set<VoxelKey>& keys)
{
  const auto step = static_cast<float>(coarse);
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        keys.insert(
            voxelKey(place + step * Eigen::Vector3i(x, y, z).cast<float>(), coarse));
}
} // namespace

MapPlane::MapPlane(const std::vector<Eigen::Vector3d>& places,
                   const Eigen::Vector3d& seen_from,
                   double gap_radius,
                   const PlaneMapOptions& options)
: sums_(places.front())
, gap_radius_(gap_radius)
, coarse_(std::max(options.max_gap, options.cell))
{
  std::unordered_set<VoxelKey> coarse_keys;
  for (const auto& p : places) {
    sums_.add(p);
    const Eigen::Vector3f place = p.cast<float>();
    cells_.emplace(voxelKey(place, options.cell), place);
    if (coarse_keys.insert(voxelKey(place, coarse_)).second)
      insertAround(place, coarse_, near_);
  }
  plane_ = sums_.fit().value_or(PlaneFit());
  if (plane_.normal.dot(seen_from) < 0)
    plane_.flip();
}

bool
MapPlane::isContinuedBy(const MapPlane& other, const PlaneMapOptions& options) const
{
  if (plane_.normal.dot(other.plane_.normal) < portableSinCos(options.max_angle).cos)
    return false;
  double steps = 0;
  std::size_t count = 0;
  for (const auto& cell : other.cells_) {
    if (near_.count(voxelKey(cell.second, coarse_)) == 0)
      continue;
    steps += std::abs(plane_.distance(cell.second.cast<double>()));
    ++count;
  }
  return count > 0 && steps < options.max_step * static_cast<double>(count);
}

void
MapPlane::join(const MapPlane& other)
{
  const auto mine = static_cast<double>(sums_.count());
  const auto theirs = static_cast<double>(other.sums_.count());
  gap_radius_ = (mine * gap_radius_ + theirs * other.gap_radius_) / (mine + theirs);
  sums_.add(other.sums_);
  cells_.insert(other.cells_.begin(), other.cells_.end());
  near_.insert(other.near_.begin(), other.near_.end());
  const Eigen::Vector3d side = plane_.normal;
  plane_ = sums_.fit().value_or(plane_);
  if (plane_.normal.dot(side) < 0)
    plane_.flip();
}

PlaneSegment
MapPlane::segment(double cell) const
{
  PlaneSegment segment;
  segment.plane.normal = segment.seen_from = plane_.normal;
  segment.plane.offset = plane_.offset;
  segment.plane.inliers = sums_.count();
  segment.plane.rms = std::sqrt(plane_.mean_square);
  orientPlane(segment.plane);
  std::vector<std::pair<VoxelKey, Eigen::Vector3f>> sorted(cells_.begin(),
                                                           cells_.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return a.first < b.first;
  });
  std::vector<Eigen::Vector3d> places;
  for (const auto& entry : sorted)
    places.push_back(entry.second.cast<double>());
  addHulls(segment, places, std::max(kCellReach * cell, gap_radius_));
  return segment;
}

} // namespace pcl6d
