// SPDX-License-Identifier: BSD-3-Clause
#include "map/map_measuring.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/require.h>
#include <pcl6d/filters/voxel_reduction.h>
#include <pcl6d/graph_relaxation/map_agreement.h>
#include <pcl6d/plane_segmentation/plane_segment.h>
#include <pcl6d/plane_segmentation/segment_planes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace pcl6d::benchmarking {
namespace {
/** \return the planes of one scan, in the world
 * \param[in] points [m] finite, in the scan's frame, the scanner at the origin */
std::vector<PlaneSegment>
planesOfScan(const Points& points, const Eigen::Isometry3d& T_world_scan)
{
  std::vector<PlaneSegment> segments = segmentPlanes(PlaneCloud(points, 1)).planes;
  for (PlaneSegment& segment : segments) {
    Plane& plane = segment.plane;
    const Eigen::Vector3d on_plane = T_world_scan * (plane.offset * plane.normal);
    plane.normal = T_world_scan.linear() * plane.normal;
    plane.offset = plane.normal.dot(on_plane);
    segment.seen_from = T_world_scan.linear() * segment.seen_from;
    for (auto& corner : plane.hull)
      corner = T_world_scan * corner;
    for (auto& ring : segment.outline)
      for (auto& corner : ring)
        corner = T_world_scan * corner;
    segment.points.clear(); // indices within a scan are useless for the map
  }
  return segments;
}

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kPairSample = 200;     ///< points for measuring a pair, each way
constexpr std::size_t kEntropySample = 1000; ///< places of a scan
constexpr double kMapCells = 5;              ///< per radius of the entropy
constexpr std::size_t kPlaneScans = 50;      ///< number of scans searched for planes
constexpr double kGateVoxels = 1.5;          ///< of the thickness of planes
constexpr double kLeastGate = 0.1;           ///< [m]
constexpr std::uint64_t kSeed = 1;

std::vector<MapScan>
prepared(const std::vector<Points>& clouds, double voxel, unsigned int num_threads)
{
  std::vector<std::optional<MapScan>> scans(clouds.size());
  parallelFor(clouds.size(), num_threads, [&](std::size_t i) {
    try {
      scans[i].emplace(clouds[i], voxel);
    } catch (const BadArgument& e) {
      throw BadArgument("scan " + std::to_string(i) + ": " + e.what());
    }
  });
  std::vector<MapScan> result;
  for (auto& scan : scans)
    result.push_back(std::move(*scan));
  return result;
}

/** Measured points, at most one per cell of each scan: a near, dense scan must not dominate. */
Points
thinnedMap(const std::vector<MapScan>& scans,
           const Poses& poses,
           double cell,
           unsigned int num_threads)
{
  std::vector<Points> parts(scans.size());
  parallelFor(scans.size(), num_threads, [&](std::size_t i) {
    ReductionOptions reduction;
    reduction.voxel = cell;
    reduction.method = ReductionMethod::kRandom;
    reduction.seed = kSeed;
    parts[i] = transformed(reducePoints(scans[i].measured, reduction), poses[i]);
  });
  Points map;
  for (const Points& part : parts)
    map.insert(map.end(), part.begin(), part.end());
  return map;
}

/** Mean over points that have an entropy. */
struct SpreadSum {
  double entropy = 0;
  double variance = 0;
  std::size_t count = 0;

  void
  add(const LocalSpread& spread)
  {
    if (std::isnan(spread.entropy))
      return;
    entropy += spread.entropy;
    variance += spread.variance;
    ++count;
  }
  double
  mean(double sum) const
  {
    return count > 0 ? sum / static_cast<double>(count) : kNothing;
  }
};
} // namespace

MapMeasuring::MapMeasuring(const std::vector<Points>& scans,
                           const std::vector<Eigen::Isometry3d>& poses,
                           const MapQualityOptions& options)
: options_(options), poses_(poses)
{
  origin_ = poses.front().translation().array().round();
  for (auto& pose : poses_)
    pose.translation() -= origin_;
  scans_ = prepared(scans, options.voxel, options.num_threads);
  for (const MapScan& scan : scans_)
    network_.emplace_back(scan.surface);
}

double
MapMeasuring::within() const
{
  return options_.within.value_or(agreementDistance(options_.voxel));
}

double
MapMeasuring::maxDistance() const
{
  return options_.max_distance.value_or(3 * options_.voxel);
}

std::size_t
MapMeasuring::revisitGap() const
{
  return options_.revisit_gap.value_or(std::max<std::size_t>(5, scans_.size() / 4));
}

void
MapMeasuring::measureAgreement(MapQuality& quality)
{
  pairs_ = visiblePairs(network_, poses_, options_.voxel, options_.num_threads);
  const MapAgreement agreement =
      agreementOver(pairs_, network_, poses_, options_.voxel, options_.num_threads);
  for (const auto& [a, b] : pairs_) {
    ++quality.scans[a].neighbours;
    ++quality.scans[b].neighbours;
  }
  quality.pairs = pairs_.size();
  quality.agreement = pairs_.empty() ? kNothing : agreement.total;
  for (std::size_t i = 0; i < scans_.size(); ++i)
    quality.scans[i].agreement =
        quality.scans[i].neighbours > 0 ? agreement.scans[i] : kNothing;
}

void
MapMeasuring::measureDistances(MapQuality& quality) const
{
  std::vector<MeasuredDistances> of_pair(pairs_.size());
  parallelFor(pairs_.size(), options_.num_threads, [&](std::size_t k) {
    const auto [a, b] = pairs_[k];
    const Eigen::Isometry3d T_a_b = poses_[a].inverse() * poses_[b];
    const auto measure = [&](std::size_t scan, std::size_t target, const auto& T) {
      return distancesBetween(
          scans_[scan], scans_[target], T, maxDistance(), kPairSample, Faces::kApart);
    };
    of_pair[k] = measure(b, a, T_a_b);
    of_pair[k].append(measure(a, b, T_a_b.inverse()));
  });
  MeasuredDistances all, steps, revisits;
  std::vector<MeasuredDistances> of_scan(scans_.size());
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const auto [a, b] = pairs_[k];
    all.append(of_pair[k]);
    of_scan[a].append(of_pair[k]);
    of_scan[b].append(of_pair[k]);
    if (b - a == 1)
      steps.append(of_pair[k]);
    if (b - a >= revisitGap()) {
      revisits.append(of_pair[k]);
      ++quality.revisit_pairs;
    }
  }
  quality.others = all.statistics(within());
  quality.steps = steps.statistics(within());
  quality.revisits = revisits.statistics(within());
  quality.revisit_blur = quality.revisits.plane.rms / quality.steps.plane.rms;
  parallelFor(scans_.size(), options_.num_threads, [&](std::size_t i) {
    quality.scans[i].others = of_scan[i].statistics(within());
  });
}

void
MapMeasuring::measureSpread(MapQuality& quality) const
{
  MapEntropyOptions options;
  options.radius = options_.radius.value_or(2 * options_.voxel);
  options.num_threads = options_.num_threads;
  const Points map =
      thinnedMap(scans_, poses_, options.radius / kMapCells, options_.num_threads);
  Points places;
  std::vector<std::size_t> end;
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const Points& sample = scans_[i].sample;
    for (std::size_t k = 0; k < sample.size();
         k += strideFor(sample.size(), kEntropySample))
      places.push_back((poses_[i] * sample[k].cast<double>()).cast<float>());
    end.push_back(places.size());
  }
  const std::vector<LocalSpread> spreads = localSpreads(places, map, options);
  SpreadSum all;
  for (std::size_t i = 0, k = 0; i < scans_.size(); ++i) {
    SpreadSum of_scan;
    for (; k < end[i]; ++k) {
      of_scan.add(spreads[k]);
      all.add(spreads[k]);
    }
    quality.scans[i].entropy = of_scan.mean(of_scan.entropy);
    quality.scans[i].plane_variance = of_scan.mean(of_scan.variance);
  }
  quality.entropy = all.mean(all.entropy);
  quality.plane_variance = all.mean(all.variance);
  quality.spread_points = all.count;
}

std::vector<PlaneSegment>
MapMeasuring::planesOfScans() const
{
  const std::size_t stride = strideFor(scans_.size(), kPlaneScans);
  std::vector<std::vector<PlaneSegment>> of_scan((scans_.size() + stride - 1) / stride);
  parallelFor(of_scan.size(), options_.num_threads, [&](std::size_t k) {
    of_scan[k] = planesOfScan(scans_[k * stride].measured, poses_[k * stride]);
  });
  std::vector<PlaneSegment> planes;
  for (const auto& one : of_scan)
    planes.insert(planes.end(), one.begin(), one.end());
  return planes;
}

void
MapMeasuring::measurePlanes(MapQuality& quality) const
{
  const std::vector<PlaneSegment> planes = planesOfScans();
  MapPoints map;
  for (std::size_t i = 0; i < scans_.size(); ++i) {
    const Eigen::Matrix3f R = poses_[i].linear().cast<float>();
    for (std::size_t k = 0; k < scans_[i].sample.size(); ++k) {
      map.points.push_back(
          (poses_[i] * scans_[i].sample[k].cast<double>()).cast<float>());
      map.normals.push_back(R * scans_[i].normals[k]);
      map.scans.push_back(static_cast<std::uint32_t>(i));
    }
  }
  PlaneThicknessOptions options;
  options.gate = std::max(kLeastGate, kGateVoxels * options_.voxel);
  options.num_threads = options_.num_threads;
  quality.thickness = planeThickness(planes, map, scans_.size(), options);
  for (ThickPlane& thick : quality.thickness.planes) {
    thick.plane.offset += thick.plane.normal.dot(origin_);
    for (auto& corner : thick.plane.hull)
      corner += origin_;
    orientPlane(thick.plane);
  }
  for (std::size_t i = 0; i < scans_.size(); ++i)
    quality.scans[i].thickness = quality.thickness.scans[i];
}

void
MapMeasuring::measureReference(const Points& reference, MapQuality& quality) const
{
  Points moved;
  for (const auto& p : reference)
    moved.push_back((p.cast<double>() - origin_).cast<float>());
  const MapScan target(moved, options_.voxel);
  std::vector<MeasuredDistances> of_scan(scans_.size());
  parallelFor(scans_.size(), options_.num_threads, [&](std::size_t i) {
    of_scan[i] = distancesBetween(scans_[i],
                                  target,
                                  poses_[i],
                                  maxDistance(),
                                  scans_[i].sample.size(),
                                  Faces::kUnknown);
    quality.scans[i].reference = of_scan[i].statistics(within());
  });
  MeasuredDistances all;
  for (const auto& one : of_scan)
    all.append(one);
  quality.reference = all.statistics(within());
}

} // namespace pcl6d::benchmarking
