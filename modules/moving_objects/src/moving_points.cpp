// SPDX-License-Identifier: BSD-3-Clause
#include "moving_clusters.h"
#include "ray_buckets.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/moving_objects/moving_points.h>
#include <pcl6d/visibility/sight_evidence.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace pcl6d {

namespace {
using namespace moving_objects;

/** So many of the nearest scans are asked what they see, spread over time ... */
constexpr std::size_t kAsked = 32;
/** ... out of so many times as many. */
constexpr std::size_t kSpread = 8;
/** Those who stand farther away than such a share of a scan's surface see little of it. */
constexpr double kReachShare = 0.9;
/** So many judges look at all places: what two of them hit and none saw through stands, as most
 * places do. */
constexpr std::size_t kFirst = 3;
constexpr int kSettled = 2;

/** So many scans, evenly over all, tell how far rays contradict scans that fit: each by so many
 * points, seen by so many others, of which the one that contradicts least counts. So many points
 * tell a share of 5 % to 0.7 %. */
constexpr std::size_t kLookedAt = 24, kPatchPoints = 1000, kFitting = 8;

/** So many points that say something tell a share of 5 % to a half. */
constexpr std::size_t kLeastSaid = 100;
/** Cubes of sightEvidence(), whose counts are not used. */
constexpr double kCountedCube = 6;

/** Rays that contradict more even where scans fit best say nothing: the bound of verification. A
 * scanner of 2002 in a corridor with glass has 0.1, one that moved while it scanned 0.03 to 0.4,
 * others 0 to 0.02, with crowds, too. */
constexpr double kMostBackground = 0.05;

/** [rad] Of a scan with too few points for an image of its own. */
constexpr double kFinest = 0.0061;

/** \return [m] how far the surfaces of a scan reach; infinite if it has none */
float
reachOf(const SeenScan& scan)
{
  if (!scan.surface || scan.surface->empty())
    return std::numeric_limits<float>::infinity();
  std::vector<float> ranges;
  ranges.reserve(scan.surface->size());
  for (const Eigen::Vector3f& p : *scan.surface)
    ranges.push_back((p - scan.rays->origin()).norm());
  const auto at =
      static_cast<std::ptrdiff_t>(kReachShare * static_cast<double>(ranges.size() - 1));
  std::nth_element(ranges.begin(), ranges.begin() + at, ranges.end());
  return ranges[static_cast<std::size_t>(at)];
}

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
  const std::size_t step = std::max<std::size_t>(1, by_place_.size() / kLookedAt);
  std::vector<double> shares((by_place_.size() + step - 1) / step);
  parallelFor(shares.size(), options_.num_threads, [&](std::size_t k) {
    shares[k] = contradictionOf(by_place_[k * step]);
  });
  shares.erase(std::remove(shares.begin(), shares.end(), -1.0), shares.end());
  background_ = upperMedian(std::move(shares));
}

bool
MovingPoints::isBlind() const
{
  return background_ > kMostBackground;
}

/** \return the share of points of a scan that the rays of the scan contradict that fits it best, of
 * a few near by; -1: none sees enough of it */
double
MovingPoints::contradictionOf(std::size_t scan) const
{
  const SeenScan& judged = scans_[scan];
  if (!judged.surface)
    return -1;
  Points some;
  const std::size_t step =
      std::max<std::size_t>(1, judged.surface->size() / kPatchPoints);
  for (std::size_t i = 0; i < judged.surface->size(); i += step)
    some.push_back((*judged.surface)[i]);
  double least = -1;
  for (const std::size_t other : around(scan, kFitting)) {
    PlaceUncertainty uncertainty;
    uncertainty.noise = judged.rays->noise();
    const SightEvidence seen =
        sightEvidence(*scans_[other].rays,
                      some,
                      scans_[other].T_world_scan.inverse() * judged.T_world_scan,
                      uncertainty,
                      kCountedCube * judged.voxel);
    if (seen.free + seen.confirmed < kLeastSaid)
      continue;
    const double share = seen.contradiction();
    least = least < 0 ? share : std::min(least, share);
  }
  return least;
}

std::vector<PointMotion>
MovingPoints::judge(std::size_t scan, const Points& points) const
{
  require(scan < scans_.size(), "scan", scan, "one of " + std::to_string(size()));
  const SeenScan& judged = scans_[scan];
  require(judged.rays != nullptr, "rays of the scan", "none", "there");
  std::vector<PointMotion> motion(points.size(), PointMotion::kUnknown);
  if (isBlind())
    return motion;
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
  const auto decided = MovingClusters(places, jury, options_.num_threads).decide();
  for (std::size_t i = 0; i < points.size(); ++i)
    if (buckets.bucket[i] != RayBuckets::kNone)
      motion[i] = decided[buckets.bucket[i]];
  return motion;
}

/** Scans that were near at other times: of those around, as far as its surfaces reach, so many as
 * can be asked, evenly over their order, as a thing that moves is elsewhere only after a while. */
std::vector<std::size_t>
MovingPoints::around(std::size_t scan, std::size_t count) const
{
  const Eigen::Vector3f here =
      (scans_[scan].T_world_scan * scans_[scan].rays->origin().cast<double>() -
       scans_.front().T_world_scan.translation())
          .cast<float>();
  const float reach = reachOf(scans_[scan]);
  std::vector<std::size_t> near;
  for (const Neighbour& n : places_.nearestK(here, count * kSpread + 1)) {
    if (near.size() >= count && n.distance_sq > reach * reach)
      break; // the nearest come first
    const std::size_t other = by_place_[static_cast<std::size_t>(n.index)];
    if (other != scan)
      near.push_back(other);
  }
  std::sort(near.begin(), near.end());
  count = std::min(count, near.size());
  std::vector<std::size_t> spread;
  for (std::size_t k = 0; k < count; ++k)
    spread.push_back(near[k * near.size() / count]);
  return spread;
}

std::vector<Judge>
MovingPoints::candidatesFor(std::size_t scan) const
{
  std::vector<Judge> candidates;
  for (const std::size_t other : around(scan, kAsked))
    candidates.emplace_back(scans_[other],
                            scans_[scan],
                            static_cast<std::ptrdiff_t>(other) -
                                static_cast<std::ptrdiff_t>(scan));
  return candidates;
}

} // namespace pcl6d
