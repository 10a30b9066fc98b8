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

/** Number of nearby scans considered as observers, spread over time ... */
constexpr std::size_t kAsked = 32;
/** ... from this multiple of the nearest scans. */
constexpr std::size_t kSpread = 8;
/** The reach of a scan is this quantile of its ranges: scans beyond see little. */
constexpr double kReachShare = 0.9;
/** Number of first observers, used for every place: a place with two hits and no miss is
 * static, like most places. */
constexpr std::size_t kFirst = 3;
constexpr int kSettled = 2;

/** For the background: number of scans, evenly chosen; points of each; and observers of each,
 * of which the observer with the fewest contradictions counts. A share of 5 % is then accurate
 * to 0.7 %. */
constexpr std::size_t kLookedAt = 24, kPatchPoints = 1000, kFitting = 8;

/** Least free or confirmed points for a background: a share of 5 % to a half. */
constexpr std::size_t kLeastSaid = 100;
/** Edge of the cubes of sightEvidence(); the counts per cube are not used. */
constexpr double kCountedCube = 6;

/** Largest background, as in verification: above, ray tests are inconclusive. A scanner of 2002
 * in a corridor with glass has 0.1, a scanner in motion during scans 0.03 to 0.4; the
 * remaining data sets have 0 to 0.02, with crowds, too. */
constexpr double kMostBackground = 0.05;

/** [rad] Cell width for a scan with too few points for its own image. */
constexpr double kFinest = 0.0061;

/** \return [m] the reach of the surfaces of a scan; infinite without surfaces */
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
          "equal to the number of points of the tree");
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

/** \return the violated share of a scan's points, by the best-fitting of a few nearby scans;
 * -1: no scan observes enough points */
double
MovingPoints::contradictionOf(std::size_t scan) const
{
  const SeenScan& observed = scans_[scan];
  if (!observed.surface)
    return -1;
  Points some;
  const std::size_t step =
      std::max<std::size_t>(1, observed.surface->size() / kPatchPoints);
  for (std::size_t i = 0; i < observed.surface->size(); i += step)
    some.push_back((*observed.surface)[i]);
  double least = -1;
  for (const std::size_t other : around(scan, kFitting)) {
    PlaceUncertainty uncertainty;
    uncertainty.noise = observed.rays->noise();
    const SightEvidence seen =
        sightEvidence(*scans_[other].rays,
                      some,
                      scans_[other].T_world_scan.inverse() * observed.T_world_scan,
                      uncertainty,
                      kCountedCube * observed.voxel);
    if (seen.free + seen.confirmed < kLeastSaid)
      continue;
    const double share = seen.contradiction();
    least = least < 0 ? share : std::min(least, share);
  }
  return least;
}

std::vector<PointMotion>
MovingPoints::classify(std::size_t scan, const Points& points) const
{
  require(scan < scans_.size(), "scan", scan, "one of " + std::to_string(size()));
  const SeenScan& observed = scans_[scan];
  require(observed.rays != nullptr, "rays of the scan", "none", "there");
  std::vector<PointMotion> motion(points.size(), PointMotion::kUnknown);
  if (isBlind())
    return motion;
  const RayImage& rays = *observed.rays;
  const double cell = rays.resolution() > 0 ? rays.resolution() : kFinest;
  const RayBuckets buckets = bucketsOf(points, rays.origin(), cell, rays.noise());
  if (buckets.places.empty())
    return motion;

  ObserverVotes votes_of_observers(
      candidatesFor(scan), observed, buckets.places, options_.num_threads);
  std::vector<std::uint32_t> open(buckets.places.size());
  std::iota(open.begin(), open.end(), 0U);
  const auto leaveOpen = [&](auto&& is_open) {
    open.erase(std::remove_if(open.begin(),
                              open.end(),
                              [&](std::uint32_t place) {
                                return !is_open(votes_of_observers.votes()[place]);
                              }),
               open.end());
  };
  const std::size_t chosen = votes_of_observers.choose(open, options_.neighbours);
  votes_of_observers.ask(open, 0, kFirst);
  leaveOpen([](const Votes& v) { return v.misses != 0 || v.numHits() < kSettled; });
  votes_of_observers.ask(open, kFirst, chosen);
  leaveOpen([](const Votes& v) { return v.misses == 0 && v.hits == 0; });
  votes_of_observers.ask(
      open, chosen, votes_of_observers.choose(open, options_.neighbours));
  const TestedPositions places{buckets.places, rays.origin(), cell, rays.noise()};
  const auto decided =
      MovingClusters(places, votes_of_observers, options_.num_threads).decide();
  for (std::size_t i = 0; i < points.size(); ++i)
    if (buckets.bucket[i] != RayBuckets::kNone)
      motion[i] = decided[buckets.bucket[i]];
  return motion;
}

/** Observers from other times: of the scans within reach of the surfaces, the allowed number,
 * evenly over their order, because an object moves away only after a while. */
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
      break; // the order is by distance
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

std::vector<Observer>
MovingPoints::candidatesFor(std::size_t scan) const
{
  std::vector<Observer> candidates;
  for (const std::size_t other : around(scan, kAsked))
    candidates.emplace_back(scans_[other],
                            scans_[scan],
                            static_cast<std::ptrdiff_t>(other) -
                                static_cast<std::ptrdiff_t>(scan));
  return candidates;
}

} // namespace pcl6d
