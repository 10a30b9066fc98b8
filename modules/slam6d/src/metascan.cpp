// SPDX-License-Identifier: BSD-3-Clause
#include "metascan.h"

#include <pcl6d/filters/voxel_reduction.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

Metascan::Metascan(double voxel, int max_scans) : voxel_(voxel), max_scans_(max_scans)
{}

void
Metascan::add(const Points& points, const Eigen::Isometry3d& T_world_scan)
{
  members_.push_back({&points, T_world_scan, radiusOf(points)});
}

Points
Metascan::around(const Eigen::Vector3d& origin, double wanted_reach) const
{
  constexpr double kGridCells = (1 << 20) - 1; // voxelKey(); one less for rounding
  const double reach = std::min(wanted_reach, kGridCells * voxel_);
  const std::size_t count = members_.size();
  const std::size_t wanted =
      max_scans_ > 0 ? std::min<std::size_t>(max_scans_, count) : count;
  Points all;
  for (std::size_t i = count - wanted; i < count; ++i) {
    const Member& member = members_[i];
    Eigen::Isometry3d T = member.T_world_scan;
    T.translation() -= origin;
    if (T.translation().norm() > reach + member.radius)
      continue;
    for (const auto& p : *member.points) {
      const Eigen::Vector3d moved = T * p.cast<double>();
      if (moved.squaredNorm() <= reach * reach)
        all.push_back(moved.cast<float>());
    }
  }
  ReductionOptions thinning;
  thinning.voxel = voxel_;
  return reducePoints(all, thinning);
}

double
radiusOf(const Points& points)
{
  float largest_sq = 0;
  for (const auto& p : points)
    largest_sq = std::max(largest_sq, p.squaredNorm());
  return std::sqrt(static_cast<double>(largest_sq));
}

} // namespace pcl6d
