// SPDX-License-Identifier: BSD-3-Clause
#include "bodies/ground_area.h"

#include <pcl6d/common/number_range.h>
#include <pcl6d/common/require.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl6d::simulation {
namespace {
constexpr double kSlack = 0.05; // of the reach: places closer to the last are skipped
} // namespace

std::size_t
GroundArea::at(const Eigen::Vector2d& place) const
{
  const Eigen::Vector2d p = (place - low) / cell;
  if (!(p.x() >= 0 && p.y() >= 0 && p.x() < static_cast<double>(columns) &&
        p.y() < static_cast<double>(rows)))
    return size();
  return static_cast<std::size_t>(p.y()) * columns + static_cast<std::size_t>(p.x());
}

Eigen::Vector2d
GroundArea::middle(std::size_t i) const
{
  return low + cell * Eigen::Vector2d(static_cast<double>(i % columns) + 0.5,
                                      static_cast<double>(i / columns) + 0.5);
}

std::size_t
GroundArea::neighbour(std::size_t i, int dx, int dy) const
{
  return at(middle(i) + cell * Eigen::Vector2d(dx, dy));
}

GroundArea
areaAround(const std::vector<Eigen::Vector3d>& places, double reach, double cell)
{
  require(!places.empty(), "number of places", places.size(), ">= 1");
  require(reach > 0 && reach <= 1000, "reach", reach, "in (0, 1000] m");
  Eigen::AlignedBox2d box;
  for (const auto& place : places) {
    require(isPlace(place), "place", place.transpose(), "within 1e9 m");
    box.extend(Eigen::Vector2d(place.head<2>()));
  }
  const Eigen::Array2d low = ((box.min().array() - reach) / cell).floor();
  const Eigen::Array2d high = ((box.max().array() + reach) / cell).ceil();
  const Eigen::Array2d size = high - low;
  if (size.prod() > kMostCells)
    throw ComputeFailed("the scanner's way covers " +
                        std::to_string(static_cast<long long>(
                            std::round(size.prod() * cell * cell / 1e6))) +
                        " km^2, too much for a map of the ground");
  return {cell * low.matrix(),
          cell,
          static_cast<std::size_t>(size.x()),
          static_cast<std::size_t>(size.y())};
}

std::vector<char>
withinReach(const GroundArea& area,
            const std::vector<Eigen::Vector3d>& places,
            double reach)
{
  std::vector<char> within(area.size(), 0);
  const auto span = static_cast<int>(std::ceil(reach / area.cell));
  const Eigen::Vector3d* last = nullptr;
  for (const auto& place : places) {
    if (last != nullptr && (place - *last).head<2>().norm() < kSlack * reach)
      continue;
    last = &place;
    const std::size_t cell = area.at(place.head<2>());
    for (int dy = -span; dy <= span; ++dy)
      for (int dx = -span; dx <= span; ++dx) {
        const std::size_t at = area.neighbour(cell, dx, dy);
        if (at < area.size() && (area.middle(at) - place.head<2>()).norm() <= reach)
          within[at] = 1;
      }
  }
  return within;
}

} // namespace pcl6d::simulation
