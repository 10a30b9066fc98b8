// SPDX-License-Identifier: BSD-3-Clause
#include "changed_things.h"
#include "moved_surfaces.h"
#include "moved_things.h"

#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using moving_objects::SurfacedRun;

namespace {
/** Adds changes of a kind, the largest first. */
void
add(std::vector<Change> some, std::vector<Change>& all)
{
  std::stable_sort(some.begin(), some.end(), [](const Change& a, const Change& b) {
    return a.points.size() > b.points.size();
  });
  for (Change& one : some)
    all.push_back(std::move(one));
}
} // namespace

const char*
toString(ChangeKind kind)
{
  switch (kind) {
  case ChangeKind::kAppeared:
    return "appeared";
  case ChangeKind::kVanished:
    return "vanished";
  case ChangeKind::kMoved:
    return "moved";
  case ChangeKind::kSurface:
    break;
  }
  return "surface";
}

double
RunChanges::contradiction() const
{
  const std::size_t free = first.seen_through + second.seen_through;
  const std::size_t all =
      free + first.there + first.shifted + second.there + second.shifted;
  return all == 0 ? 0 : static_cast<double>(free) / static_cast<double>(all);
}

void
RunChangesOptions::validate() const
{
  const auto positive = [](const char* name, double value) {
    require(std::isfinite(value) && value > 0, name, value, "finite and > 0");
  };
  positive("voxel", voxel);
  require(std::isfinite(noise) && noise >= 0, "noise", noise, "finite and >= 0");
  positive("gap", gap);
  positive("least_size", least_size);
  require(min_confidence >= 0 && min_confidence < 1,
          "min_confidence",
          min_confidence,
          "in [0, 1)");
  constexpr double kUnit = 1e-6;
  require(std::abs(up.norm() - 1) < kUnit, "up", up.transpose(), "a unit vector");
  surfaces.validate();
}

RunChanges
findChanges(const ComparedRun& first,
            const ComparedRun& second,
            const RunChangesOptions& given)
{
  RunChangesOptions options = given;
  options.surfaces.voxel = options.voxel;
  options.surfaces.num_threads = options.num_threads;
  options.validate();
  requireComplete(first, "first run");
  requireComplete(second, "second run");
  const moving_objects::RunSurface on_first(first, options.voxel, options.num_threads);
  const moving_objects::RunSurface on_second(
      second, options.voxel, options.num_threads);
  const SurfacedRun a{first, on_first}, b{second, on_second};
  auto gone = moving_objects::seenThrough(a, b, options);
  auto come = moving_objects::seenThrough(b, a, options);
  auto things = moving_objects::changedThings(gone, come, options);
  RunChanges result;
  result.first = gone.tally;
  result.second = come.tally;
  result.background = things.background;
  add(moving_objects::takeMoved(things.vanished, things.appeared, options),
      result.changes);
  add(std::move(things.appeared), result.changes);
  add(std::move(things.vanished), result.changes);
  result.distances = moving_objects::distancesBetween(a, b, options.surfaces);
  const auto back = moving_objects::distancesBetween(b, a, options.surfaces);
  add(moving_objects::movedSurfaces(result.distances, back, result.changes, options),
      result.changes);
  return result;
}

} // namespace pcl6d
