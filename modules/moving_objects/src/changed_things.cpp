// SPDX-License-Identifier: BSD-3-Clause
#include "change_box.h"
#include "changed_things.h"

#include <pcl6d/common/components.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/voxel_numbers.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace pcl6d::moving_objects {

namespace {
/** Beyond so many voxels residuals of points hang together by less than a third
 * (algorithms.md T.3), so that patches of this edge are witnesses of their own ... */
constexpr double kPatchVoxels = 3;
/** ... and a plane has so many voxels in one. */
constexpr double kVoxelsOfPatch = kPatchVoxels * kPatchVoxels;

/** A patch is seen through with so many gone voxels, and half of all (algorithms.md T.1). */
constexpr std::size_t kLeastGone = 3;

/** A thing of fewer voxels has no shape: of a cube of three voxels two sides are seen, without
 * its foot, in twelve. */
constexpr std::size_t kLeastVoxels = 8;

/** A sheet of fewer voxels, two patches and a half, may be a part of a larger thing. */
constexpr std::size_t kMostOfPart = 24;
/** Points of a sheet lie up to half a voxel, and noise, on both sides. */
constexpr double kSheetVoxels = 1.5;
/** A sheet of its own as flat as that has so many voxels, four by four: smaller ones are the
 * rims of plates that were seen along. */
constexpr double kFlatVoxels = 0.5;
constexpr std::size_t kLeastOfSheet = 16;

/** A thing stands out where less than so large a share of it is next to what is there: the
 * foot of a cube of three voxels is a third, leaves and edges are nearly all fringe. */
constexpr double kMostFringe = 0.7;

/** Of a thing the other run saw through most of what it saw: it has fewer voxels in its box of
 * which nothing is known. Of trees behind trees it is the other way round. */
constexpr double kMostUnknown = 1;

/** So many scans beyond the first count as patches: their poses err alike. */
constexpr std::uint32_t kMostFurther = 3;

/** Gone voxels that are near each other, as places in SeenThrough::gone. */
using Cluster = std::vector<std::size_t>;

std::vector<Cluster>
clustersOf(const std::vector<GoneVoxel>& gone, double gap, unsigned int num_threads)
{
  Points places;
  for (const GoneVoxel& one : gone)
    places.push_back(one.place);
  const PointTree tree(places, num_threads);
  Components components(gone.size());
  for (std::size_t i = 0; i < gone.size(); ++i)
    for (const Neighbour& near :
         tree.withinRadius(places[i], static_cast<float>(gap * gap)))
      components.join(i, static_cast<std::size_t>(near.index));
  std::map<std::size_t, Cluster> by_first;
  for (std::size_t i = 0; i < gone.size(); ++i)
    by_first[components.firstOf(i)].push_back(i);
  std::vector<Cluster> clusters;
  clusters.reserve(by_first.size());
  for (auto& [first, cluster] : by_first)
    clusters.push_back(std::move(cluster));
  return clusters;
}

/** \return the number of places in a box, or by so much beside it [m] */
std::size_t
countIn(const ChangeBox& box,
        double beside,
        const Points& places,
        const PointTree& tree)
{
  const Eigen::Vector3d half = box.size / 2 + Eigen::Vector3d::Constant(beside);
  const Eigen::Isometry3d T_box_world = box.T_world_box.inverse();
  std::size_t count = 0;
  for (const Neighbour& near :
       tree.withinRadius(box.T_world_box.translation().cast<float>(),
                         static_cast<float>(half.squaredNorm()))) {
    const auto& p = places[static_cast<std::size_t>(near.index)];
    const Eigen::Vector3d own = T_box_world * p.cast<double>();
    count += (own.cwiseAbs().array() <= half.array()).all() ? 1 : 0;
  }
  return count;
}

/** \return whether it is large enough and stands out */
bool
isThing(const Cluster& cluster,
        const std::vector<GoneVoxel>& gone,
        const ChangeBox& box,
        const RunChangesOptions& options)
{
  // Points are in the middle of what they stand for: a voxel is missing at the ends.
  const double longest = box.size.maxCoeff() + options.voxel;
  const auto fringe = std::count_if(
      cluster.begin(), cluster.end(), [&](std::size_t i) { return gone[i].on_fringe; });
  const bool is_flat = box.size.minCoeff() < kFlatVoxels * options.voxel;
  return cluster.size() >= (is_flat ? kLeastOfSheet : kLeastVoxels) &&
         longest >= options.least_size * options.voxel &&
         static_cast<double>(fringe) <
             kMostFringe * static_cast<double>(cluster.size());
}

Points
placesOf(const Cluster& cluster, const std::vector<GoneVoxel>& gone)
{
  Points places;
  for (const std::size_t i : cluster)
    places.push_back(gone[i].place);
  return places;
}

/** A thing that parts may be of. */
struct Whole {
  std::size_t cluster;
  ChangeBox box;
  PointTree tree;
};

/** \return whether all places lie in a box, or by so much beside it [m] */
bool
areInside(const Points& places, const ChangeBox& box, double beside)
{
  const Eigen::Isometry3d T_box_world = box.T_world_box.inverse();
  const Eigen::Vector3d half = box.size / 2 + Eigen::Vector3d::Constant(beside);
  return std::all_of(places.begin(), places.end(), [&](const Eigen::Vector3f& p) {
    const Eigen::Vector3d own = T_box_world * p.cast<double>();
    return (own.cwiseAbs().array() <= half.array()).all();
  });
}

/** \return whether all places are within the longest edge of a thing from it */
bool
areNear(const Points& places, const Whole& whole)
{
  const auto reach = static_cast<float>(whole.box.size.maxCoeff());
  return std::all_of(places.begin(), places.end(), [&](const Eigen::Vector3f& p) {
    return whole.tree.hasNeighbour(p, reach * reach);
  });
}

/** \return of each cluster, the largest first, the one that it is a part of; itself if of
 * none. A part lies in the box of what it is of, as the legs of a table do; or it is small and
 * thin, and within its longest edge: what was seen of a thing through gaps, and points in the
 * air behind its edges, where beams were divided. */
std::vector<std::size_t>
wholesOf(const std::vector<Cluster>& clusters,
         const std::vector<GoneVoxel>& gone,
         const RunChangesOptions& options)
{
  std::vector<std::size_t> wholes;
  std::vector<Whole> large;
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    const Points places = placesOf(clusters[k], gone);
    const ChangeBox box = boxAbout(places, options.up);
    const bool is_small = places.size() < kMostOfPart &&
                          box.size.minCoeff() <= kSheetVoxels * options.voxel;
    const auto of = std::find_if(large.begin(), large.end(), [&](const Whole& whole) {
      return areInside(places, whole.box, options.gap * options.voxel) ||
             (is_small && areNear(places, whole));
    });
    wholes.push_back(of == large.end() ? k : of->cluster);
    if (of == large.end() && places.size() >= kMostOfPart)
      large.push_back({k, box, PointTree(places, 1)});
  }
  return wholes;
}

/** Things of a run, and what remains. */
struct Things {
  std::vector<Change> things;
  std::vector<Cluster> clusters; ///< of each, with parts that are not among its points
  std::vector<char> is_of_thing; ///< of each gone voxel

  void
  add(const Cluster& cluster, std::size_t thing)
  {
    for (const std::size_t i : cluster)
      is_of_thing[i] = 1;
    clusters[thing].insert(clusters[thing].end(), cluster.begin(), cluster.end());
  }
};

/** \return the median number of scans that saw through */
std::size_t
usualWitnesses(const Cluster& cluster, const std::vector<GoneVoxel>& gone)
{
  std::vector<double> witnesses;
  for (const std::size_t i : cluster)
    witnesses.push_back(gone[i].witnesses);
  return static_cast<std::size_t>(upperMedian(std::move(witnesses)));
}

Things
thingsOf(const SeenThrough& seen, const RunChangesOptions& options)
{
  Things found;
  found.is_of_thing.resize(seen.gone.size());
  auto clusters =
      clustersOf(seen.gone, options.gap * options.voxel, options.num_threads);
  std::stable_sort(
      clusters.begin(), clusters.end(), [](const Cluster& a, const Cluster& b) {
        return a.size() > b.size();
      });
  const auto wholes = wholesOf(clusters, seen.gone, options);
  const PointTree unknown(seen.unknown, options.num_threads);
  std::map<std::size_t, std::size_t> things; // of clusters
  for (std::size_t k = 0; k < clusters.size(); ++k) {
    if (wholes[k] != k) {
      const auto thing = things.find(wholes[k]);
      if (thing != things.end())
        found.add(clusters[k], thing->second);
      continue;
    }
    Change thing;
    thing.points = placesOf(clusters[k], seen.gone);
    thing.box = boxAbout(thing.points, options.up);
    if (!isThing(clusters[k], seen.gone, thing.box, options))
      continue;
    const std::size_t hidden = countIn(thing.box, options.voxel, seen.unknown, unknown);
    if (static_cast<double>(hidden) >
        kMostUnknown * static_cast<double>(thing.points.size()))
      continue;
    thing.witnesses = usualWitnesses(clusters[k], seen.gone);
    things[k] = found.things.size();
    found.things.push_back(std::move(thing));
    found.clusters.emplace_back();
    found.add(clusters[k], found.things.size() - 1);
  }
  return found;
}

/** Patches of a run, and how many were seen through outside of things. */
struct Patches {
  std::size_t all = 0;
  std::size_t by_chance = 0;
};

Patches
patchesOf(const SeenThrough& seen, const Things& things, double patch)
{
  VoxelNumbers numbers;
  std::vector<std::size_t> there, gone;
  const auto add = [&](const Eigen::Vector3f& place, bool is_gone) {
    const auto [number, is_new] = numbers.add(voxelKey(place, patch));
    if (is_new) {
      there.push_back(0);
      gone.push_back(0);
    }
    ++(is_gone ? gone : there)[number];
  };
  for (const auto& place : seen.there)
    add(place, false);
  for (std::size_t i = 0; i < seen.gone.size(); ++i)
    if (!things.is_of_thing[i])
      add(seen.gone[i].place, true);
  Patches patches;
  patches.all = there.size();
  for (std::size_t k = 0; k < there.size(); ++k)
    patches.by_chance += gone[k] >= kLeastGone && gone[k] >= there[k] ? 1 : 0;
  return patches;
}

/** Gives things their confidence, and keeps those that are sure enough. */
std::vector<Change>
sureThings(Things found,
           ChangeKind kind,
           double places,
           double background,
           const RunChangesOptions& options,
           SeenThrough& seen)
{
  std::vector<Change> sure;
  for (std::size_t k = 0; k < found.things.size(); ++k) {
    Change& thing = found.things[k];
    const auto further = std::min<std::size_t>(thing.witnesses - 1, kMostFurther);
    const double patches = static_cast<double>(thing.points.size()) / kVoxelsOfPatch +
                           static_cast<double>(further);
    thing.kind = kind;
    thing.confidence = confidenceOf(places, background, patches);
    if (thing.confidence < options.min_confidence)
      continue;
    for (const std::size_t i : found.clusters[k])
      seen.tally.changed += seen.gone[i].points;
    sure.push_back(std::move(thing));
  }
  return sure;
}
} // namespace

double
confidenceOf(double places, double background, double patches)
{
  return 1 / (1 + places * portableExp(patches * portableLog(background)));
}

ChangedThings
changedThings(SeenThrough& first, SeenThrough& second, const RunChangesOptions& options)
{
  Things of_first = thingsOf(first, options), of_second = thingsOf(second, options);
  const double edge = kPatchVoxels * options.voxel;
  const Patches a = patchesOf(first, of_first, edge);
  const Patches b = patchesOf(second, of_second, edge);
  // Laplace's rule: what was not met in N places may be met in the next one.
  const double places = static_cast<double>(a.all + b.all + 1);
  ChangedThings changed;
  changed.background =
      static_cast<double>(a.by_chance + b.by_chance + 1) / (places + 1);
  changed.vanished = sureThings(std::move(of_first),
                                ChangeKind::kVanished,
                                places,
                                changed.background,
                                options,
                                first);
  changed.appeared = sureThings(std::move(of_second),
                                ChangeKind::kAppeared,
                                places,
                                changed.background,
                                options,
                                second);
  return changed;
}

} // namespace pcl6d::moving_objects
