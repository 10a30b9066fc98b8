// SPDX-License-Identifier: BSD-3-Clause
#include "seen_through.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/voxel_numbers.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::moving_objects {

namespace {
enum class State : std::uint8_t { kUnknown, kThere, kShifted, kGone, kRestless };

/** [voxels] Largest distance of points from two reductions of one plane; a surface of the other
 * run within it is unchanged. */
constexpr double kThereVoxels = 1;

/** Shifted surfaces have normals within 45 degrees: cosine. */
constexpr float kSameSide = 0.7071F;

/** [voxels] Unchanged points this near to a gone voxel make the voxel a fringe. */
constexpr double kFringeVoxels = 1.5;

/** Least distance of the end of a ray behind a point, to have passed through its surface, in
 * standard deviations. A ray that passes a point by the tolerance of an image ends on the
 * plane of the point, farther by the tolerance over the cosine of its incidence. If the cells
 * below are empty, rays miss an unchanged plane by up to one cell and a half; a tolerance is
 * three standard deviations. */
constexpr float kThroughPlane = 4.5F;

/** A point is dynamic within its run if the number of violating scans exceeds the number of
 * scans that hit the point by this factor: a few scans miss the legs of a chair. */
constexpr std::uint32_t kRestlessTimes = 2;

/** Rays at a grazing angle below 6 deg miss thin objects, like the top of a table, and are not
 * used. */
constexpr float kGrazing = 0.1F;

/** State of the points of a scan. */
struct ScanStates {
  Points places; ///< [m] in the world
  std::vector<State> states;
  std::vector<std::uint32_t> num_observers;
};

/** \return whether a surface with similar orientation lies on the normal of a point */
bool
isShifted(const Eigen::Vector3f& place,
          const Eigen::Vector3f& normal,
          const RunSurface& surface,
          const RunChangesOptions& options)
{
  if (normal.isZero(0))
    return false;
  const auto depth = static_cast<float>(options.surfaces.depth * options.voxel);
  const auto radius = static_cast<float>(kThereVoxels * options.voxel);
  for (const Neighbour& near :
       surface.tree().withinRadius(place, depth * depth + radius * radius)) {
    const auto k = static_cast<std::size_t>(near.index);
    const float along = (surface.points()[k] - place).dot(normal);
    if (std::abs(along) <= depth &&
        near.distance_sq - along * along <= radius * radius &&
        surface.normals()[k].dot(normal) > kSameSide)
      return true;
  }
  return false;
}

/** Counts of the rays of several scans at given points. */
struct ViewCounts {
  std::vector<std::uint32_t> free, confirmed;
};

/** Points of a scan to be tested by rays. */
struct Asked {
  const ComparedScan& scan;
  Points places, normals; ///< in the world; zero: no normal
};

/** \return whether the rays passed through the surface of a point, not along it */
bool
wentThrough(const SightOfPlace& seen,
            const Eigen::Vector3f& normal,
            const Eigen::Vector3f& ray)
{
  if (seen.sight != Sight::kFree)
    return false;
  const float cosine = std::abs(normal.dot(ray.normalized()));
  return normal.isZero(0) ||
         (cosine > kGrazing && seen.sigmas * cosine > kThroughPlane);
}

/** Tests points by every scan of a run except one. */
ViewCounts
countsOf(const ComparedRun& run,
         const ComparedScan* without,
         const Asked& asked,
         double noise)
{
  ViewCounts counts{std::vector<std::uint32_t>(asked.places.size()),
                    std::vector<std::uint32_t>(asked.places.size())};
  for (const ComparedScan& other : run) {
    if (&other == without || asked.places.empty())
      continue;
    const Eigen::Isometry3d T_other_world = other.T_world_scan.inverse();
    const Eigen::Vector3d eye =
        other.T_world_scan * other.rays->origin().cast<double>();
    Points places;
    std::vector<float> sigmas;
    for (const auto& p : asked.places) {
      const Eigen::Vector3d place = p.cast<double>();
      const double variance =
          noise * noise + poseVariance(asked.scan, place, (place - eye).normalized());
      places.emplace_back((T_other_world * place).cast<float>());
      sigmas.push_back(static_cast<float>(std::sqrt(variance)));
    }
    const auto seen = other.rays->look(places, sigmas);
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Eigen::Vector3f ray = asked.places[k] - eye.cast<float>();
      counts.free[k] += wentThrough(seen[k], asked.normals[k], ray) ? 1 : 0;
      counts.confirmed[k] += seen[k].sight == Sight::kConfirmed ? 1 : 0;
    }
  }
  return counts;
}

/** Tests points by the rays of the other run: the majority decides. Points violated by scans of
 * their own run, too, are dynamic within the run, or not on a surface. */
void
askRays(const ComparedScan& scan,
        const ComparedRun& own,
        const ComparedRun& by,
        double noise,
        const std::vector<std::size_t>& open,
        ScanStates& states)
{
  const Eigen::Matrix3f R = scan.T_world_scan.linear().cast<float>();
  Asked asked{scan, {}, {}}, gone{scan, {}, {}};
  for (const std::size_t i : open) {
    asked.places.push_back(states.places[i]);
    asked.normals.emplace_back(R * (*scan.normals)[i]);
  }
  const ViewCounts counts = countsOf(by, nullptr, asked, noise);
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < open.size(); ++k) {
    const std::size_t i = open[k];
    states.num_observers[i] = counts.free[k];
    states.states[i] = counts.confirmed[k] > 0 ? State::kThere : State::kUnknown;
    if (counts.free[k] <= counts.confirmed[k])
      continue;
    states.states[i] = State::kGone;
    places.push_back(i);
    gone.places.push_back(asked.places[k]);
    gone.normals.push_back(asked.normals[k]);
  }
  const ViewCounts own_counts = countsOf(own, &scan, gone, noise);
  for (std::size_t k = 0; k < places.size(); ++k)
    if (own_counts.free[k] > kRestlessTimes * (own_counts.confirmed[k] + 1))
      states.states[places[k]] = State::kRestless;
}

ScanStates
statesOf(const ComparedScan& scan,
         const ComparedRun& own,
         const SurfacedRun& by,
         const RunChangesOptions& options)
{
  ScanStates states;
  states.places = transformed(*scan.points, scan.T_world_scan);
  states.states.resize(states.places.size(), State::kThere);
  states.num_observers.resize(states.places.size());
  const double there = kThereVoxels * options.voxel;
  const Eigen::Matrix3f R = scan.T_world_scan.linear().cast<float>();
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < states.places.size(); ++i) {
    if (by.surface.tree().hasNeighbour(states.places[i],
                                       static_cast<float>(there * there)))
      continue;
    if (isShifted(states.places[i], R * (*scan.normals)[i], by.surface, options))
      states.states[i] = State::kShifted;
    else
      open.push_back(i);
  }
  askRays(scan, own, by.run, options.noise, open, states);
  return states;
}

/** Sums of the points in a voxel. */
struct Voxel {
  Eigen::Vector3d gone = Eigen::Vector3d::Zero(), other = Eigen::Vector3d::Zero();
  std::uint32_t num_gone = 0, num_there = 0, num_unknown = 0, num_observers = 0;
};

void
tally(const ScanStates& scan, RunTally& sum)
{
  for (const State state : scan.states) {
    ++sum.points;
    ++(state == State::kThere      ? sum.there
       : state == State::kShifted  ? sum.shifted
       : state == State::kGone     ? sum.seen_through
       : state == State::kRestless ? sum.restless
                                   : sum.unknown);
  }
}

std::vector<Voxel>
voxelsOf(const std::vector<ScanStates>& scans, double voxel)
{
  VoxelNumbers numbers;
  std::vector<Voxel> voxels;
  for (const ScanStates& scan : scans)
    for (std::size_t i = 0; i < scan.places.size(); ++i) {
      const State state = scan.states[i];
      const auto [number, is_new] = numbers.add(voxelKey(scan.places[i], voxel));
      if (is_new)
        voxels.emplace_back();
      Voxel& one = voxels[number];
      const bool is_gone = state == State::kGone;
      const bool is_unknown = state == State::kUnknown || state == State::kRestless;
      ++(is_gone ? one.num_gone : is_unknown ? one.num_unknown : one.num_there);
      (is_gone ? one.gone : one.other) += scan.places[i].cast<double>();
      one.num_observers = std::max(one.num_observers, scan.num_observers[i]);
    }
  return voxels;
}
} // namespace

SeenThrough
seenThrough(const SurfacedRun& of,
            const SurfacedRun& by,
            const RunChangesOptions& options)
{
  std::vector<ScanStates> scans(of.run.size());
  constexpr std::size_t kBatch = 8; // to report progress
  for (std::size_t begin = 0; begin < scans.size(); begin += kBatch) {
    const std::size_t end = std::min(begin + kBatch, scans.size());
    parallelFor(end - begin, options.num_threads, [&](std::size_t k) {
      scans[begin + k] = statesOf(of.run[begin + k], of.run, by, options);
    });
    if (options.progress)
      options.progress({"comparing", end, scans.size()});
  }
  SeenThrough result;
  for (const ScanStates& scan : scans)
    tally(scan, result.tally);
  for (const Voxel& one : voxelsOf(scans, options.voxel))
    if (one.num_gone > one.num_there)
      result.gone.push_back({(one.gone / one.num_gone).cast<float>(),
                             one.num_gone,
                             one.num_observers,
                             false});
    else if (one.num_there + one.num_unknown > 0) {
      const auto others = static_cast<double>(one.num_there + one.num_unknown);
      (one.num_there > 0 ? result.there : result.unknown)
          .emplace_back((one.other / others).cast<float>());
    }
  const PointTree tree(result.there, options.num_threads);
  const double fringe = kFringeVoxels * options.voxel;
  for (GoneVoxel& one : result.gone)
    one.on_fringe = tree.hasNeighbour(one.place, static_cast<float>(fringe * fringe));
  return result;
}

} // namespace pcl6d::moving_objects
