// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_moments.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>
#include <pcl6d/plane_segmentation/plane_region_growing.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl6d {
using namespace plane_segmentation;

namespace {
constexpr int kRounds = 3; // of growing a region, each from the plane of the last
/** Noise of a surfel over the noise of a point: the mean of twenty. */
constexpr double kSurfelNoise = 0.5;

/** Grows regions one by one; a surfel belongs to one region at most. */
class Grower {
public:
  Grower(const PlaneCloud& cloud, const RegionGrowingOptions& options)
  : surfels_(cloud.surfels())
  , options_(options)
  , least_cosine_(portableSinCos(options.max_angle).cos)
  , taken_(surfels_.size(), 0)
  , seen_(surfels_.size(), 0)
  {}

  /** \return smooth surfels, the smoothest first */
  std::vector<std::uint32_t>
  seeds() const
  {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < surfels_.size(); ++i)
      if (surfels_.smooth[i])
        order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) {
      return surfels_.roughness[a] * surfels_.noise[b] <
             surfels_.roughness[b] * surfels_.noise[a];
    });
    return order;
  }

  bool
  isFree(std::uint32_t surfel) const
  {
    return !taken_[surfel];
  }

  /** \return the surfels of the region about a seed; empty for a small region */
  std::vector<std::uint32_t>
  grow(std::uint32_t seed)
  {
    PlaneFit plane;
    plane.normal = surfels_.normals[seed].cast<double>();
    plane.offset = plane.normal.dot(surfels_.points[seed].cast<double>());
    region_ = {seed};
    for (int round = 0; round < kRounds; ++round) {
      growFrom(plane);
      if (region_.size() < options_.min_surfels)
        return {};
    }
    for (const auto i : region_)
      taken_[i] = 1;
    return region_;
  }

private:
  /** Grows from the part of the region that lies on a plane, and updates the plane. */
  void
  growFrom(PlaneFit& plane)
  {
    ++growth_;
    sums_ = PlaneMoments(surfels_.points[region_.front()].cast<double>());
    squares_ = 0;
    std::vector<std::uint32_t> before;
    before.swap(region_);
    for (const auto i : before)
      join(i, plane);
    std::size_t next_fit = 2 * options_.min_surfels;
    for (std::size_t next = 0; next < region_.size(); ++next) {
      const std::uint32_t i = region_[next];
      if (!surfels_.smooth[i])
        continue; // the rim: part of the region, but not grown from, as it leads to
                  // other surfaces
      for (std::size_t k = surfels_.link_begin[i]; k < surfels_.link_begin[i + 1]; ++k)
        join(surfels_.links[k], plane);
      if (region_.size() >= next_fit) {
        update(plane);
        next_fit = region_.size() + region_.size() / 4;
      }
    }
    update(plane);
  }

  /** Adds a surfel that is on the plane and keeps the region flat. */
  void
  join(std::uint32_t i, const PlaneFit& plane)
  {
    if (taken_[i] || seen_[i] == growth_)
      return;
    seen_[i] = growth_;
    const Eigen::Vector3d place = surfels_.points[i].cast<double>();
    const double sigma = kSurfelNoise * surfels_.noise[i];
    const double distance = plane.distance(place) / sigma;
    if (std::abs(distance) > options_.max_plane_distance)
      return;
    if (surfels_.smooth[i] &&
        plane.normal.dot(surfels_.normals[i].cast<double>()) < least_cosine_)
      return;
    const double squares = squares_ + distance * distance;
    if (squares > options_.max_rms * options_.max_rms *
                      static_cast<double>(std::max<std::size_t>(region_.size() + 1,
                                                                options_.min_surfels)))
      return;
    squares_ = squares;
    sums_.add(place, 1 / (sigma * sigma));
    region_.push_back(i);
  }

  void
  update(PlaneFit& plane)
  {
    auto fitted = sums_.fit();
    if (!fitted)
      return;
    if (fitted->normal.dot(plane.normal) < 0)
      fitted->flip();
    plane = *fitted;
    squares_ = plane.mean_square * static_cast<double>(region_.size());
  }

  const Surfels& surfels_;
  const RegionGrowingOptions& options_;
  const double least_cosine_;
  std::vector<char> taken_;
  std::vector<std::uint32_t> seen_; // the last growth that tested a surfel
  std::uint32_t growth_ = 0;
  std::vector<std::uint32_t> region_;
  PlaneMoments sums_;  // of the region, weighted by 1 / sigma^2
  double squares_ = 0; // [sigma^2] of the region's distances to its plane
};
} // namespace

void
RegionGrowingOptions::validate() const
{
  require(max_plane_distance > 0 && std::isfinite(max_plane_distance),
          "max_plane_distance",
          max_plane_distance,
          "> 0 and finite");
  require(max_rms > 0 && std::isfinite(max_rms), "max_rms", max_rms, "> 0 and finite");
  require(
      max_angle > 0 && max_angle < M_PI / 2, "max_angle", max_angle, "in (0, pi/2)");
  require(min_surfels >= 3, "min_surfels", min_surfels, ">= 3");
}

PlaneCandidates
regionGrowingCandidates(const PlaneCloud& cloud, const RegionGrowingOptions& options)
{
  options.validate();
  const Surfels& surfels = cloud.surfels();
  Grower grower(cloud, options);
  PlaneCandidates candidates;
  for (const auto seed : grower.seeds()) {
    if (!grower.isFree(seed))
      continue;
    const auto region = grower.grow(seed);
    if (region.empty())
      continue;
    candidates.emplace_back();
    for (const auto i : region)
      candidates.back().insert(candidates.back().end(),
                               surfels.members.begin() + surfels.begin[i],
                               surfels.members.begin() + surfels.begin[i + 1]);
  }
  return candidates;
}

} // namespace pcl6d
