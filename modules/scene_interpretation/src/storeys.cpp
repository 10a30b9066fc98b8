// SPDX-License-Identifier: BSD-3-Clause
#include "storeys.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pcl6d::scene_interpretation {
namespace {
constexpr double kNear = 1.0;           // [m] in plan: beside a floor
constexpr double kOver = 0.3;           // [m] in plan: under a ceiling
constexpr double kMinCeilingArea = 1.0; // [m^2] no lintel, no board

// Floors at one height, given by the largest plane.
struct Level {
  double height = 0;
  double area = 0;
  std::vector<std::size_t> planes;
};

class StoreyFinder {
public:
  StoreyFinder(const std::vector<ScenePlane>& planes,
               const InterpretationOptions& options)
  : planes_(planes), options_(options)
  {
    for (std::size_t i = 0; i < planes.size(); ++i)
      if (planes[i].inclination < options.tolerances.angle)
        level_planes_.push_back(i);
    std::stable_sort(
        level_planes_.begin(), level_planes_.end(), [&](std::size_t a, std::size_t b) {
          return planes[a].area > planes[b].area;
        });
  }

  std::vector<Level>
  findLevels() const
  {
    std::vector<Level> levels;
    for (const auto i : level_planes_)
      if (isSeenFromAbove(planes_[i]))
        addFloor(i, levels);
    if (levels.empty())
      addLowest(levels);
    std::stable_sort(levels.begin(), levels.end(), [](const Level& a, const Level& b) {
      return a.height < b.height;
    });
    return levels;
  }

  // Storey of the highest floor under a plane; floors beside or under the plane first.
  std::size_t
  storeyOf(std::size_t plane, const std::vector<Level>& levels) const
  {
    const double foot = planes_[plane].bottom + options_.tolerances.height;
    std::optional<std::size_t> near, any;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      if (levels[i].height > foot)
        break;
      any = i;
      if (isBeside(plane, levels[i], kNear))
        near = i;
    }
    return near ? *near : any ? *any : 0;
  }

  // The largest plane seen from below in a storey, if possible over the given plane.
  std::optional<double>
  ceilingOver(const ScenePlane& plane,
              const std::optional<double>& floor,
              const std::vector<std::size_t>& storey_of,
              std::size_t storey) const
  {
    std::optional<double> largest;
    for (const auto i : level_planes_) {
      if (storey_of[i] != storey || !isCeiling(planes_[i], floor))
        continue;
      if (overlapInPlan(planes_[i], plane, kOver))
        return planes_[i].centre.z();
      if (!largest)
        largest = planes_[i].centre.z();
    }
    return largest;
  }

private:
  static bool
  isSeenFromAbove(const ScenePlane& plane)
  {
    return plane.side_known && plane.normal.z() > 0;
  }

  bool
  isCeiling(const ScenePlane& plane, const std::optional<double>& floor) const
  {
    return (!plane.side_known || plane.normal.z() < 0) &&
           plane.area >= kMinCeilingArea &&
           (!floor || plane.centre.z() > *floor + options_.min_headroom);
  }

  bool
  isBeside(std::size_t plane, const Level& level, double margin) const
  {
    return std::any_of(
        level.planes.begin(), level.planes.end(), [&](std::size_t floor) {
          return overlapInPlan(planes_[floor], planes_[plane], margin);
        });
  }

  // A plane at the height of a floor belongs to the floor. Without headroom over or
  // under a larger floor in plan, the plane is a table or a step.
  void
  addFloor(std::size_t plane, std::vector<Level>& levels) const
  {
    const double height = planes_[plane].centre.z();
    const auto isAt = [&](const Level& level) {
      return std::abs(level.height - height) < options_.tolerances.height;
    };
    const auto isTooNear = [&](const Level& level) {
      return !isAt(level) && std::abs(level.height - height) < options_.min_headroom &&
             isBeside(plane, level, 0);
    };
    if (std::any_of(levels.begin(), levels.end(), isTooNear))
      return;
    const auto level = std::find_if(levels.begin(), levels.end(), isAt);
    if (level != levels.end()) {
      level->planes.push_back(plane);
      level->area += planes_[plane].area;
    }
    else if (levels.empty() || planes_[plane].area >= options_.min_floor_area)
      levels.push_back({height, planes_[plane].area, {plane}});
  }

  // Fallback without a plane seen from above: the lowest large plane.
  void
  addLowest(std::vector<Level>& levels) const
  {
    constexpr double kShare = 0.1; // of the largest area
    std::optional<std::size_t> lowest;
    for (const auto i : level_planes_)
      if (!planes_[i].side_known &&
          planes_[i].area >= kShare * planes_[level_planes_.front()].area &&
          (!lowest || planes_[i].centre.z() < planes_[*lowest].centre.z()))
        lowest = i;
    if (lowest)
      levels.push_back({planes_[*lowest].centre.z(), planes_[*lowest].area, {*lowest}});
  }

  const std::vector<ScenePlane>& planes_;
  const InterpretationOptions& options_;
  std::vector<std::size_t> level_planes_; // by falling area
};
} // namespace

void
findStoreys(std::vector<ScenePlane>& planes,
            const InterpretationOptions& options,
            Interpretation& result)
{
  const StoreyFinder finder(planes, options);
  const std::vector<Level> levels = finder.findLevels();
  result.storeys.assign(std::max<std::size_t>(levels.size(), 1), {});
  for (std::size_t i = 0; i < levels.size(); ++i) {
    result.storeys[i].floor = levels[i].height;
    result.storeys[i].area = levels[i].area;
  }
  result.storey_of.assign(planes.size(), 0);
  for (std::size_t i = 0; i < planes.size(); ++i)
    result.storey_of[i] = finder.storeyOf(i, levels);
  std::vector<std::optional<double>> ceilings;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const std::size_t storey = result.storey_of[i];
    ceilings.push_back(finder.ceilingOver(
        planes[i], result.storeys[storey].floor, result.storey_of, storey));
  }
  ScenePlane nowhere;
  for (std::size_t s = 0; s < result.storeys.size(); ++s)
    result.storeys[s].ceiling =
        finder.ceilingOver(nowhere, result.storeys[s].floor, result.storey_of, s);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    planes[i].floor = result.storeys[result.storey_of[i]].floor;
    planes[i].ceiling = ceilings[i];
    // For a wall through several storeys, the centre is that of the part in its own
    // storey.
    if (ceilings[i] && planes[i].bottom < *ceilings[i] && planes[i].top > *ceilings[i])
      planes[i].centre.z() = (planes[i].bottom + *ceilings[i]) / 2;
  }
}

} // namespace pcl6d::scene_interpretation
