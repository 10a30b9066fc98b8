// SPDX-License-Identifier: BSD-3-Clause
#include "surface_distances.h"

#include <pcl6d/common/median.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/voxel_numbers.h>
#include <pcl6d/filters/surface_patch.h>
#include <pcl6d/moving_objects/surface_distance.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace pcl6d {
using moving_objects::poseVariance;
using moving_objects::RunSurface;
using moving_objects::SurfacedRun;

namespace {
/** Largest share of the spread of a planar patch across the plane: for a plane with noise of
 * half a voxel, seen within three voxels, the share is 0.05. */
constexpr float kMostCurvature = 0.05F;

/** Least cosine of normals of one surface: 60 degrees. */
constexpr float kAlike = 0.5F;

constexpr double kOf95 = 1.96; ///< standard deviations: 95 % of a normal distribution

/** Points of a run in a cylinder. */
struct InCylinder {
  double mean = 0;    ///< [m] along the normal
  double within = 0;  ///< [m^2] variance of points about the means of their scans
  double between = 0; ///< [m^2] variance of the means; 0 for one scan
  double pose = 0;    ///< [m^2] variance by the poses of the scans, in the mean
  Eigen::Vector3d middle =
      Eigen::Vector3d::Zero(); ///< [m] of the points, from the core
  double tilt = 0; ///< sine of the angle between their normals and the core's normal
  std::size_t points = 0; ///< 0: no points
  std::size_t scans = 0;
};

/** Sums of the points of a scan in a cylinder. */
struct OfScan {
  std::uint32_t scan;
  double sum = 0, sum_sq = 0;
  Eigen::Vector3d offsets = Eigen::Vector3d::Zero();
  Eigen::Vector3d normals = Eigen::Vector3d::Zero();
  std::size_t count = 0;
};

std::vector<OfScan>
sumsOf(const RunSurface& surface,
       const Eigen::Vector3f& place,
       const Eigen::Vector3f& normal,
       const SurfaceDistanceOptions& options)
{
  const auto radius = static_cast<float>(options.cylinder * options.voxel);
  const auto depth = static_cast<float>(options.depth * options.voxel);
  std::vector<OfScan> sums;
  for (const Neighbour& near :
       surface.tree().withinRadius(place, radius * radius + depth * depth)) {
    const auto k = static_cast<std::size_t>(near.index);
    const Eigen::Vector3f offset = surface.points()[k] - place;
    const float along = offset.dot(normal);
    if (std::abs(along) > depth || near.distance_sq - along * along > radius * radius ||
        surface.normals()[k].dot(normal) < kAlike)
      continue;
    const std::uint32_t scan = surface.scans()[k];
    auto own = std::find_if(
        sums.begin(), sums.end(), [&](const OfScan& one) { return one.scan == scan; });
    if (own == sums.end())
      own = sums.insert(own, OfScan{scan});
    own->sum += along;
    own->sum_sq += static_cast<double>(along) * along;
    own->offsets += offset.cast<double>();
    own->normals += surface.normals()[k].cast<double>();
    ++own->count;
  }
  return sums;
}

InCylinder
inCylinder(const SurfacedRun& of,
           const Eigen::Vector3f& place,
           const Eigen::Vector3f& normal,
           const SurfaceDistanceOptions& options)
{
  InCylinder found;
  const auto sums = sumsOf(of.surface, place, normal, options);
  Eigen::Vector3d facing = Eigen::Vector3d::Zero();
  for (const OfScan& one : sums) {
    found.points += one.count;
    found.mean += one.sum;
    found.middle += one.offsets;
    facing += one.normals;
  }
  if (found.points < options.least_points)
    return {};
  const auto points = static_cast<double>(found.points);
  found.scans = sums.size();
  const auto scans = static_cast<double>(found.scans);
  found.mean /= points;
  found.middle /= points;
  found.tilt = facing.normalized().cross(normal.cast<double>()).norm();
  for (const OfScan& one : sums) {
    const auto count = static_cast<double>(one.count);
    const double mean = one.sum / count;
    found.within += std::max(0.0, one.sum_sq - count * mean * mean) / points;
    found.between +=
        (mean - found.mean) * (mean - found.mean) / std::max(scans - 1, 1.0);
    found.pose +=
        poseVariance(of.run[one.scan], place.cast<double>(), normal.cast<double>()) /
        scans;
  }
  if (found.scans == 1)
    found.between = 0;
  return found;
}

/** A core point with the points of both runs around it. */
struct Core {
  SurfaceDistance distance;
  InCylinder of, to;
};

/** \return positions on the surface: the point next to the middle of each cell */
Points
corePlaces(const RunSurface& surface, double spacing, Normals& facing)
{
  VoxelNumbers cells;
  std::vector<std::size_t> chosen;
  std::vector<float> distances;
  for (std::size_t i = 0; i < surface.points().size(); ++i) {
    const Eigen::Vector3f& p = surface.points()[i];
    const VoxelKey key = voxelKey(p, spacing);
    const float distance = (voxelCentre(key, spacing) - p).squaredNorm();
    const auto [number, is_new] = cells.add(key);
    if (is_new) {
      chosen.push_back(i);
      distances.push_back(distance);
    }
    else if (distance < distances[number]) {
      chosen[number] = i;
      distances[number] = distance;
    }
  }
  Points places;
  for (const std::size_t i : chosen) {
    places.push_back(surface.points()[i]);
    facing.push_back(surface.normals()[i]);
  }
  return places;
}

/** \return the median variance between scans, over cores with several scans; [m^2] */
double
usualBetween(const std::vector<std::optional<Core>>& cores, InCylinder Core::*run)
{
  std::vector<double> all;
  for (const auto& core : cores)
    if (core && ((*core).*run).scans > 1)
      all.push_back(((*core).*run).between);
  return upperMedian(std::move(all));
}

/** \return the ratio of distances to their stated deviations; at least 1 */
double
scaleOf(const std::vector<std::optional<Core>>& cores)
{
  // Of a normal distribution: half lies within 0.6745, three quarters within 1.1503.
  constexpr double kHalf = 0.6745, kThreeQuarters = 1.1503;
  std::vector<double> ratios;
  for (const auto& core : cores)
    if (core && core->distance.lod > 0)
      ratios.push_back(std::abs(core->distance.distance) * kOf95 / core->distance.lod);
  if (ratios.empty())
    return 1;
  std::sort(ratios.begin(), ratios.end());
  return std::max({1.0,
                   ratios[ratios.size() / 2] / kHalf,
                   ratios[ratios.size() * 3 / 4] / kThreeQuarters});
}

double
varianceOf(const InCylinder& run, double usual)
{
  return (run.within + std::max(run.between, usual)) / static_cast<double>(run.scans);
}

/** \return [m^2] variance by a wrong normal, for means of points beside each other */
double
tiltVariance(const Core& core)
{
  const Eigen::Vector3d n = core.distance.normal.cast<double>();
  const Eigen::Vector3d beside = core.to.middle - core.of.middle;
  const double across = (beside - beside.dot(n) * n).norm();
  const double tilt = std::max(core.of.tilt, core.to.tilt);
  return across * across * tilt * tilt;
}

/** \return both runs at each core point, without a level of detection; empty where the
 * surface is not planar, or a run has too few points */
std::vector<std::optional<Core>>
coresOf(const SurfacedRun& of,
        const SurfacedRun& to,
        const SurfaceDistanceOptions& options)
{
  Normals facing;
  const Points places = corePlaces(of.surface, options.spacing * options.voxel, facing);
  PatchSize size;
  size.radius = options.normal * options.voxel;
  const auto patches = fitPatches(
      places, of.surface.points(), of.surface.tree(), size, options.num_threads);
  std::vector<std::optional<Core>> cores(places.size());
  constexpr std::size_t kBlock = 256;
  parallelBlocks(places.size(), kBlock, options.num_threads, [&](const Block& block) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      Eigen::Vector3f normal = patches[i].normal;
      if (normal.isZero(0) || patches[i].curvature > kMostCurvature)
        continue;
      if (normal.dot(facing[i]) < 0)
        normal = -normal;
      Core core{{places[i], normal}, {}, {}};
      core.to = inCylinder(to, places[i], normal, options);
      if (core.to.points > 0)
        core.of = inCylinder(of, places[i], normal, options);
      if (core.of.points == 0)
        continue;
      core.distance.distance = core.to.mean - core.of.mean;
      core.distance.points = std::min(core.of.points, core.to.points);
      cores[i] = core;
    }
  });
  return cores;
}
} // namespace

void
SurfaceDistanceOptions::validate() const
{
  const auto positive = [](const char* name, double value) {
    require(std::isfinite(value) && value > 0, name, value, "finite and > 0");
  };
  positive("voxel", voxel);
  positive("spacing", spacing);
  positive("normal", normal);
  positive("cylinder", cylinder);
  positive("depth", depth);
  require(least_points > 0, "least_points", least_points, "> 0");
}

std::vector<SurfaceDistance>
surfaceDistances(const ComparedRun& of,
                 const ComparedRun& to,
                 const SurfaceDistanceOptions& options)
{
  options.validate();
  requireComplete(of, "first run");
  requireComplete(to, "second run");
  return moving_objects::distancesBetween(
      {of, RunSurface(of, options.voxel, options.num_threads)},
      {to, RunSurface(to, options.voxel, options.num_threads)},
      options);
}

std::vector<SurfaceDistance>
moving_objects::distancesBetween(const SurfacedRun& of,
                                 const SurfacedRun& to,
                                 const SurfaceDistanceOptions& options)
{
  auto cores = coresOf(of, to, options);
  const double usual_of = usualBetween(cores, &Core::of);
  const double usual_to = usualBetween(cores, &Core::to);
  for (auto& core : cores)
    if (core)
      core->distance.lod =
          kOf95 *
          std::sqrt(varianceOf(core->of, usual_of) + varianceOf(core->to, usual_to) +
                    (core->of.pose + core->to.pose) / 2 + tiltVariance(*core));
  const double scale = scaleOf(cores);
  std::vector<SurfaceDistance> distances;
  for (const auto& core : cores)
    if (core) {
      distances.push_back(core->distance);
      distances.back().lod *= scale;
    }
  return distances;
}

} // namespace pcl6d
