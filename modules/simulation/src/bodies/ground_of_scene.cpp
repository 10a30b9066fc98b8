// SPDX-License-Identifier: BSD-3-Clause
#include "bodies/ground_area.h"

#include <pcl6d/common/error.h>
#include <pcl6d/simulation/ground_survey.h>

#include <array>
#include <cmath>
#include <limits>

namespace pcl6d {
using namespace simulation;

namespace {
constexpr double kFine = 0.1, kCoarse = 0.2; // [m] cells
constexpr double kFarApart = 60;             // [m] places
constexpr double kUneven = 0.02;             // [m] steps of a rough floor
constexpr std::array<double, 3> kLookHeights = {0.25, 0.9, 1.6}; // [m] above the floor

double
cellFor(const std::vector<Eigen::Vector3d>& places)
{
  Eigen::AlignedBox2d box;
  for (const auto& place : places)
    box.extend(Eigen::Vector2d(place.head<2>()));
  return box.isEmpty() || box.sizes().maxCoeff() <= kFarApart ? kFine : kCoarse;
}

/** \brief Walks from cell to cell. */
class Walk {
public:
  Walk(const RayCaster& caster, GroundArea area, std::vector<char> within)
  : caster_(caster)
  , area_(std::move(area))
  , within_(std::move(within))
  , floors_(area_.size(), kNoFloor)
  , is_blocked_(area_.size(), 0)
  {}

  void
  startBelow(const Eigen::Vector3d& place, double height)
  {
    const std::size_t cell = area_.at(place.head<2>());
    if (std::isnan(floors_[cell]))
      if (const auto floor = floorAt(cell, place.z() - height, 0.3 + area_.cell))
        reach(cell, *floor);
  }

  GroundMap
  finish()
  {
    for (std::size_t i = 0; i < open_.size(); ++i)
      for (const auto& [dx, dy] : kSteps)
        step(open_[i], dx, dy);
    if (open_.empty())
      throw ComputeFailed("no floor below the way of the scanner");
    for (std::size_t i = 0; i < floors_.size(); ++i)
      if (is_blocked_[i] != 0)
        floors_[i] = kNoFloor;
    return GroundMap(
        {area_.low, area_.cell, area_.columns, area_.rows, std::move(floors_)});
  }

private:
  static constexpr std::array<std::array<int, 2>, 8> kSteps = {
      {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

  // The floor, if the first surface below 2 m is near the expected height.
  std::optional<double>
  floorAt(std::size_t cell, double expected, double tolerance) const
  {
    const Eigen::Vector2d middle = area_.middle(cell);
    const Eigen::Vector3d above(middle.x(), middle.y(), expected + kBodyHeight);
    const auto hit =
        caster_.cast({above, -Eigen::Vector3d::UnitZ()}, kBodyHeight + tolerance);
    if (!hit || hit->range < kBodyHeight - tolerance)
      return std::nullopt;
    return above.z() - hit->range;
  }

  void
  reach(std::size_t cell, double floor)
  {
    floors_[cell] = floor;
    open_.push_back(cell);
  }

  void
  step(std::size_t from, int dx, int dy)
  {
    const std::size_t to = area_.neighbour(from, dx, dy);
    if (to >= area_.size() || within_[to] == 0)
      return;
    if (is_blocked_[from] != 0 && std::isnan(floors_[to]))
      return; // no body can stand there to go on
    const double length = (area_.middle(to) - area_.middle(from)).norm();
    if (std::isnan(floors_[to]) && is_blocked_[to] == 0) {
      const auto floor = floorAt(to, floors_[from], kUneven + kSteepest * length);
      if (floor && !isCut(from, to, *floor))
        reach(to, *floor);
      else
        is_blocked_[from] = 1; // the cell beyond may be reached from elsewhere
    }
    else if (isCut(from, to, floors_[to])) {
      is_blocked_[from] = is_blocked_[to] = 1;
    }
  }

  // Whether an obstacle is between two cells, or their floors differ too much.
  bool
  isCut(std::size_t from, std::size_t to, double floor) const
  {
    if (std::isnan(floor))
      return true;
    const Eigen::Vector2d a = area_.middle(from);
    const Eigen::Vector2d b = area_.middle(to);
    const double length = (b - a).norm();
    if (std::abs(floor - floors_[from]) > kUneven + kSteepest * length)
      return true;
    for (const double height : kLookHeights) {
      const Eigen::Vector3d p(a.x(), a.y(), floors_[from] + height);
      const Eigen::Vector3d way = Eigen::Vector3d(b.x(), b.y(), floor + height) - p;
      if (caster_.cast({p, way.normalized()}, way.norm()))
        return true;
    }
    return false;
  }

  const RayCaster& caster_;
  GroundArea area_;
  std::vector<char> within_;
  std::vector<double> floors_;
  std::vector<char> is_blocked_; // occupied
  std::vector<std::size_t> open_;
};
} // namespace

GroundMap
groundOfScene(const RayCaster& caster,
              const std::vector<Eigen::Vector3d>& places,
              double height,
              double reach)
{
  const GroundArea area = areaAround(places, reach, cellFor(places));
  Walk walk(caster, area, withinReach(area, places, reach));
  for (const auto& place : places)
    walk.startBelow(place, height);
  return walk.finish();
}

} // namespace pcl6d
