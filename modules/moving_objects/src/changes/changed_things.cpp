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
/** [voxels] From half of this distance on, residuals of points are correlated by 0.01 to 0.33
 * (recorded and simulated scans): patches with this edge count as independent ... */
constexpr double kPatchVoxels = 3;
/** ... and a plane has this many voxels in a patch. */
constexpr double kVoxelsOfPatch = kPatchVoxels * kPatchVoxels;

/** Least gone voxels of a patch; half of its voxels, too (share/doc/trust.md, Counting). */
constexpr std::size_t kLeastGone = 3;

/** Smaller objects have no shape [voxels]: the two visible sides of a cube of three voxels,
 * without its foot, have twelve. */
constexpr std::size_t kLeastVoxels = 8;

/** A sheet with fewer voxels, two patches and a half, may be part of a larger object. */
constexpr std::size_t kMostOfPart = 24;
/** Points of a sheet lie on both sides, by up to half a voxel and the noise. */
constexpr double kSheetVoxels = 1.5;
/** A separate sheet as flat as this needs four by four voxels: smaller sheets are the rims of
 * plates seen edge-on. */
constexpr double kFlatVoxels = 0.5;
constexpr std::size_t kLeastOfSheet = 16;

/** Largest share of an object next to unchanged points: the foot of a cube of three voxels is a
 * third; leaves and edges lie nearly everywhere next to unchanged points. */
constexpr double kMostFringe = 0.7;

/** Largest ratio of unknown voxels in the box of an object to its own: of a real object most
 * voxels are violated. For trees behind trees the ratio is larger. */
constexpr double kMostUnknown = 1;

/** The most further scans that count as patches: the errors of poses are correlated. */
constexpr std::uint32_t kMostFurther = 3;

/** Clusters of neighbouring gone voxels, by their indices in SeenThrough::gone. */
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

/** \return the number of positions in a box, or outside by up to a margin [m] */
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

/** \return whether the object is large enough and differs from unchanged surfaces */
bool
isThing(const Cluster& cluster,
        const std::vector<GoneVoxel>& gone,
        const ChangeBox& box,
        const RunChangesOptions& options)
{
  // Points are centres of voxels: half a voxel is missing at each end.
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

/** An object that may have parts. */
struct Whole {
  std::size_t cluster;
  ChangeBox box;
  PointTree tree;
};

/** \return whether every position lies in a box, or outside by up to a margin [m] */
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

/** \return whether every position is within the longest edge of an object from the object */
bool
areNear(const Points& places, const Whole& whole)
{
  const auto reach = static_cast<float>(whole.box.size.maxCoeff());
  return std::all_of(places.begin(), places.end(), [&](const Eigen::Vector3f& p) {
    return whole.tree.hasNeighbour(p, reach * reach);
  });
}

/** \return for each cluster, the largest first, the cluster of which it is a part; else itself.
 * A part lies in the box of the whole, like the legs of a table. Or a part is small and thin,
 * and within the longest edge of the whole: pieces of an object seen through gaps, and points
 * in the air behind its edges, from divided beams. */
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

/** Objects of a run, and the remaining clusters. */
struct Things {
  std::vector<Change> things;
  std::vector<Cluster> clusters; ///< of each object, without its parts
  std::vector<char> is_of_thing; ///< of each gone voxel

  void
  add(const Cluster& cluster, std::size_t thing)
  {
    for (const std::size_t i : cluster)
      is_of_thing[i] = 1;
    clusters[thing].insert(clusters[thing].end(), cluster.begin(), cluster.end());
  }
};

/** \return the median number of scans that violate the points */
std::size_t
usualObservers(const Cluster& cluster, const std::vector<GoneVoxel>& gone)
{
  std::vector<double> num_observers;
  for (const std::size_t i : cluster)
    num_observers.push_back(gone[i].num_observers);
  return static_cast<std::size_t>(upperMedian(std::move(num_observers)));
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
    thing.num_observers = usualObservers(clusters[k], seen.gone);
    things[k] = found.things.size();
    found.things.push_back(std::move(thing));
    found.clusters.emplace_back();
    found.add(clusters[k], found.things.size() - 1);
  }
  return found;
}

/** Patches of a run, and the number seen through outside of objects. */
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

/** Computes the confidence of objects, and keeps the objects with enough confidence. */
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
    const auto further = std::min<std::size_t>(thing.num_observers - 1, kMostFurther);
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
  // Laplace's rule: an event not seen in N trials may occur in the next.
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
