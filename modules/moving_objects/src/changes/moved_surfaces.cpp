// SPDX-License-Identifier: BSD-3-Clause
#include "change_box.h"
#include "moved_surfaces.h"

#include <pcl6d/common/components.h>
#include <pcl6d/common/median.h>
#include <pcl6d/common/portable_math.h>
#include <pcl6d/search/point_tree.h>

#include <cmath>
#include <map>

namespace pcl6d::moving_objects {

namespace {
/** Core points of an area, of both runs together: three times three of each. */
constexpr std::size_t kLeastCores = 18;

/** [voxels] Significant core points this near to an object belong to the object. */
constexpr double kOfThingVoxels = 3;

/** A core point with a significant change. */
struct MovedCore {
  Eigen::Vector3f place;
  double change; ///< [m] towards the scanner, from the first run to the second
  double lod;    ///< [m]
};

void
addMoved(const std::vector<SurfaceDistance>& distances,
         double sign,
         const PointTree& things,
         double near,
         std::vector<MovedCore>& moved)
{
  for (const SurfaceDistance& one : distances)
    if (one.isSignificant() &&
        !things.hasNeighbour(one.place, static_cast<float>(near * near)))
      moved.push_back({one.place, sign * one.distance, one.lod});
}

/** \return groups of neighbouring core points with a change in one direction */
std::vector<std::vector<std::size_t>>
areasOf(const std::vector<MovedCore>& cores, double reach, unsigned int num_threads)
{
  Points places;
  for (const MovedCore& core : cores)
    places.push_back(core.place);
  const PointTree tree(places, num_threads);
  Components components(cores.size());
  for (std::size_t i = 0; i < cores.size(); ++i)
    for (const Neighbour& near :
         tree.withinRadius(places[i], static_cast<float>(reach * reach))) {
      const auto k = static_cast<std::size_t>(near.index);
      if ((cores[k].change > 0) == (cores[i].change > 0))
        components.join(i, k);
    }
  std::map<std::size_t, std::vector<std::size_t>> by_first;
  for (std::size_t i = 0; i < cores.size(); ++i)
    by_first[components.firstOf(i)].push_back(i);
  std::vector<std::vector<std::size_t>> areas;
  for (auto& [first, area] : by_first)
    if (area.size() >= kLeastCores)
      areas.push_back(std::move(area));
  return areas;
}

Change
surfaceOf(const std::vector<MovedCore>& cores,
          const std::vector<std::size_t>& area,
          const Eigen::Vector3d& up)
{
  Change change;
  change.kind = ChangeKind::kSurface;
  std::vector<double> distances, lods;
  for (const std::size_t i : area) {
    change.points.push_back(cores[i].place);
    distances.push_back(cores[i].change);
    lods.push_back(cores[i].lod);
  }
  change.box = boxAbout(change.points, up);
  change.distance = upperMedian(std::move(distances));
  change.lod = upperMedian(std::move(lods));
  return change;
}
} // namespace

std::vector<Change>
movedSurfaces(const std::vector<SurfaceDistance>& first,
              const std::vector<SurfaceDistance>& second,
              const std::vector<Change>& things,
              const RunChangesOptions& options)
{
  Points of_things;
  for (const Change& thing : things) {
    of_things.insert(of_things.end(), thing.points.begin(), thing.points.end());
    of_things.insert(
        of_things.end(), thing.points_before.begin(), thing.points_before.end());
  }
  const PointTree tree(of_things, options.num_threads);
  const double near = kOfThingVoxels * options.voxel;
  std::vector<MovedCore> cores;
  addMoved(first, 1, tree, near, cores);
  addMoved(second, -1, tree, near, cores);
  const double spacing = options.surfaces.spacing * options.voxel;
  const double places =
      static_cast<double>(first.size() + second.size()) / kLeastCores + 1;
  std::vector<Change> changes;
  for (const auto& area : areasOf(cores, 2 * spacing, options.num_threads)) {
    Change change = surfaceOf(cores, area, options.up);
    // The errors of an area may be correlated. Beyond z deviations, on both sides,
    // lies a share of a normal distribution below exp(-z^2 / 2).
    const double z = 1.96 * change.distance / change.lod;
    change.confidence = 1 / (1 + places * portableExp(-z * z / 2));
    if (change.confidence >= options.min_confidence)
      changes.push_back(std::move(change));
  }
  return changes;
}

} // namespace pcl6d::moving_objects
