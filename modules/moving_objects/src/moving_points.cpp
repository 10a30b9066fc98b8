// SPDX-License-Identifier: BSD-3-Clause
#include "moving_clusters.h"
#include "ray_buckets.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/moving_objects/moving_points.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pcl6d {

namespace {
using namespace moving_objects;

/** So many of the nearest scans are asked what they see, spread over time ... */
constexpr std::size_t kAsked = 32;
/** ... out of so many times as many. */
constexpr std::size_t kSpread = 8;
/** So many judges look at all places: what two of them hit and none saw through stands, as most
 * places do. */
constexpr std::size_t kFirst = 3;
constexpr int kSettled = 2;

/** [rad] Of a scan with too few points for an image of its own. */
constexpr double kFinest = 0.0061;

void
requireSeen(const SeenScan& scan, std::size_t i)
{
  const std::string name = "scan " + std::to_string(i) + ": ";
  require(isRigid(scan.T_world_scan),
          (name + "T_world_scan").c_str(),
          "not one",
          "a rigid motion");
  const auto sigma = [&](const char* what, double value) {
    require(std::isfinite(value) && value >= 0,
            (name + "sigma of " + what).c_str(),
            value,
            "finite and >= 0");
  };
  sigma("translation", scan.sigma.translation);
  sigma("rotation", scan.sigma.rotation);
  if (!scan.surface)
    return;
  require(scan.tree && scan.normals && scan.normals->size() == scan.surface->size(),
          (name + "normals of the surface").c_str(),
          scan.normals ? scan.normals->size() : 0,
          "with a tree, one per point");
  require(std::isfinite(scan.voxel) && scan.voxel > 0,
          (name + "voxel").c_str(),
          scan.voxel,
          "finite and > 0");
}
} // namespace

void
MovingPointsOptions::validate() const
{
  require(neighbours >= 1 && neighbours <= 8, "neighbours", neighbours, "in [1, 8]");
}

MovingPoints::MovingPoints(std::vector<SeenScan> scans,
                           const MovingPointsOptions& options)
: scans_(std::move(scans)), options_(options)
{
  options_.validate();
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    requireSeen(scans_[i], i);
    if (!scans_[i].rays || scans_[i].rays->resolution() == 0)
      continue;
    const auto& T = scans_[i].T_world_scan;
    const Eigen::Vector3d origin = T * scans_[i].rays->origin().cast<double>();
    origins_.push_back(
        (origin - scans_.front().T_world_scan.translation()).cast<float>());
    by_place_.push_back(i);
  }
  places_ = PointTree(origins_, options_.num_threads);
}

std::vector<PointMotion>
MovingPoints::judge(std::size_t scan, const Points& points) const
{
  require(scan < scans_.size(), "scan", scan, "one of " + std::to_string(size()));
  const SeenScan& judged = scans_[scan];
  require(judged.rays != nullptr, "rays of the scan", "none", "there");
  std::vector<PointMotion> motion(points.size(), PointMotion::kUnknown);
  const RayImage& rays = *judged.rays;
  const double cell = rays.resolution() > 0 ? rays.resolution() : kFinest;
  const RayBuckets buckets = bucketsOf(points, rays.origin(), cell, rays.noise());
  if (buckets.places.empty())
    return motion;

  Jury jury(candidatesFor(scan), judged, buckets.places, options_.num_threads);
  std::vector<std::uint32_t> open(buckets.places.size());
  std::iota(open.begin(), open.end(), 0U);
  const auto leaveOpen = [&](auto&& is_open) {
    open.erase(std::remove_if(
                   open.begin(),
                   open.end(),
                   [&](std::uint32_t place) { return !is_open(jury.votes()[place]); }),
               open.end());
  };
  const std::size_t chosen = jury.choose(open, options_.neighbours);
  jury.ask(open, 0, kFirst);
  leaveOpen([](const Votes& v) { return v.misses != 0 || v.numHits() < kSettled; });
  jury.ask(open, kFirst, chosen);
  leaveOpen([](const Votes& v) { return v.misses == 0 && v.hits == 0; });
  jury.ask(open, chosen, jury.choose(open, options_.neighbours));
  const JudgedPlaces places{buckets.places, rays.origin(), cell, rays.noise()};
  const auto decided =
      MovingClusters(places, jury.votes(), jury.judges(), options_.num_threads)
          .decide();
  for (std::size_t i = 0; i < points.size(); ++i)
    if (buckets.bucket[i] != RayBuckets::kNone)
      motion[i] = decided[buckets.bucket[i]];
  return motion;
}

/** Scans that were near at other times: of those around, so many as can be asked, evenly over
 * their order, as a thing that moves is elsewhere only after a while. */
std::vector<Judge>
MovingPoints::candidatesFor(std::size_t scan) const
{
  const SeenScan& judged = scans_[scan];
  const Eigen::Vector3f here =
      (judged.T_world_scan * judged.rays->origin().cast<double>() -
       scans_.front().T_world_scan.translation())
          .cast<float>();
  std::vector<std::size_t> around;
  for (const Neighbour& n : places_.nearestK(here, kAsked * kSpread + 1)) {
    const std::size_t other = by_place_[static_cast<std::size_t>(n.index)];
    if (other != scan)
      around.push_back(other);
  }
  std::sort(around.begin(), around.end());
  std::vector<Judge> candidates;
  const std::size_t count = std::min(kAsked, around.size());
  for (std::size_t k = 0; k < count; ++k)
    candidates.emplace_back(scans_[around[k * around.size() / count]], judged);
  return candidates;
}

} // namespace pcl6d
