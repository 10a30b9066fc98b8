// SPDX-License-Identifier: BSD-3-Clause
#include "seen_through.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/voxel_numbers.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::moving_objects {

namespace {
enum class State : std::uint8_t { kUnknown, kThere, kShifted, kGone, kRestless };

/** A surface of the other run within so many voxels is the same one: two reductions of one
 * plane have their points so far apart. */
constexpr double kThereVoxels = 1;

/** Shifted surfaces face alike within 45 degrees. */
constexpr float kSameSide = 0.7071F;

/** What is there within so many voxels of a gone voxel makes it a fringe. */
constexpr double kFringeVoxels = 1.5;

/** Rays that pass a place by the tolerance of an image end on the plane through it farther on
 * by that over the cosine of their incidence. A plane that is still there may be missed by one
 * cell and a half, where the cells below are empty: so rays have gone through it if they ended
 * farther on than this. In standard deviations, of which a tolerance is three. */
constexpr float kThroughPlane = 4.5F;

/** What moves within a run was seen through by so many times the scans of it that saw it: the
 * legs of a chair are missed by some. */
constexpr std::uint32_t kRestlessTimes = 2;

/** Rays that graze a surface by less than 6 deg miss what is thin, as the top of a table: they
 * say nothing of it. */
constexpr float kGrazing = 0.1F;

/** What is known of the points of a scan. */
struct ScanStates {
  Points places; ///< [m] in the world
  std::vector<State> states;
  std::vector<std::uint32_t> witnesses;
};

/** \return whether a surface that faces alike lies on the normal of a point */
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

/** What rays say of places. */
struct ViewCounts {
  std::vector<std::uint32_t> free, confirmed;
};

/** Places of a scan that rays are asked for. */
struct Asked {
  const ComparedScan& scan;
  Points places, normals; ///< in the world; zero normals: none
};

/** \return whether the rays went through the surface of a place, not along it */
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

/** Asks all scans of a run but one. */
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

/** The rays of all scans of the other run: who saw through outvotes who did not. What the
 * other scans of its own run saw through, too, moves in it, or is no surface. */
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
    states.witnesses[i] = counts.free[k];
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
  states.witnesses.resize(states.places.size());
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
  std::uint32_t num_gone = 0, num_there = 0, num_unknown = 0, witnesses = 0;
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
      one.witnesses = std::max(one.witnesses, scan.witnesses[i]);
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
  constexpr std::size_t kBatch = 8; // to show how far it is
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
                             one.witnesses,
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
