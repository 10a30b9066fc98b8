// SPDX-License-Identifier: BSD-3-Clause
#include "sweep_sample.h"

#include <pcl6d/common/require.h>
#include <pcl6d/common/voxel_numbers.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::odometry {

namespace {
/** Voxels are numbered up to 2^20 either way. */
constexpr float kFarVoxels = 1048575;
} // namespace

SweepSpan
spanOf(const Points& points, const std::vector<double>& times, double max_range)
{
  require(times.empty() || times.size() == points.size(),
          "number of times",
          times.size(),
          "one per point, " + std::to_string(points.size()));
  SweepSpan span;
  double begin = INFINITY, end = -INFINITY;
  for (const double time : times)
    if (std::isfinite(time)) {
      begin = std::min(begin, time);
      end = std::max(end, time);
    }
  const bool is_timed = begin < end;
  if (begin <= end) {
    span.begin = begin;
    span.end = end;
  }
  span.points.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float range_sq = points[i].squaredNorm();
    if (!points[i].allFinite() || !(range_sq > 0) || range_sq > max_range * max_range)
      continue;
    if (!times.empty() && !std::isfinite(times[i]))
      continue;
    const double share = is_timed ? (times[i] - begin) / (end - begin) : 0;
    span.points.push_back({points[i], static_cast<float>(share)});
  }
  return span;
}

SweepPoints
thinned(const SweepPoints& points, double voxel)
{
  SweepPoints kept;
  VoxelNumbers seen;
  for (const SweepPoint& p : points)
    if (p.point.cwiseAbs().maxCoeff() < kFarVoxels * static_cast<float>(voxel) &&
        seen.add(voxelKey(p.point, voxel)).second)
      kept.push_back(p);
  return kept;
}

SweepPoints
SweepSampler::sample(const SweepPoints& points)
{
  SweepPoints sample = thinned(points, voxel_);
  // On surfaces the count falls with the square of the edge.
  const double excess =
      static_cast<double>(sample.size()) / static_cast<double>(wanted_);
  voxel_ = std::max(least_, voxel_ * std::sqrt(std::clamp(excess, 0.25, 4.0)));
  return sample;
}

Points
inFrameOf(const Eigen::Isometry3d& T_world_sweep,
          const std::vector<Eigen::Vector3d>& places)
{
  const Eigen::Isometry3d T_sweep_world = T_world_sweep.inverse();
  Points points;
  points.reserve(places.size());
  for (const Eigen::Vector3d& place : places)
    points.emplace_back((T_sweep_world * place).cast<float>());
  return points;
}

double
rangeOfShare(const SweepPoints& points, double share)
{
  std::vector<float> ranges;
  ranges.reserve(points.size());
  for (const SweepPoint& p : points)
    ranges.push_back(p.point.norm());
  if (ranges.empty())
    return 0;
  const auto place =
      ranges.begin() +
      static_cast<std::ptrdiff_t>(share * static_cast<double>(ranges.size() - 1));
  std::nth_element(ranges.begin(), place, ranges.end());
  return *place;
}

} // namespace pcl6d::odometry
