// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/simulation/ground_map.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace pcl6d {
namespace {
// The corners of a way that cannot be left out; empty if a disc does not fit.
std::vector<Eigen::Vector2d>
straightened(const std::vector<Eigen::Vector2d>& corners,
             const GroundMap& map,
             double radius)
{
  std::vector<Eigen::Vector2d> way = {corners.front()};
  for (std::size_t from = 0; from + 1 < corners.size();) {
    std::size_t to = corners.size() - 1;
    while (to > from + 1 && !map.isFree(corners[from], corners[to], radius))
      to = from + 1 + (to - from - 1) / 2;
    if (!map.isFree(corners[from], corners[to], radius))
      return {};
    way.push_back(corners[to]);
    from = to;
  }
  return way;
}
} // namespace

struct GroundMap::Search {
  // State of a cell in the search: length of the best way, and the previous cell.
  struct Reached {
    double length;
    std::size_t before;
    bool is_done = false;
  };

  const GroundMap& map;
  double radius, longest; // [m]
  Eigen::Vector2d to;
  using Entry = std::tuple<double, std::size_t>; // length through a cell at least, cell
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open = {};
  std::unordered_map<std::size_t, Reached> reached = {};

  void
  reach(std::size_t cell, std::size_t before, double length)
  {
    const double through = length + (map.middle(cell) - to).norm();
    if (through > longest)
      return;
    const auto [known, is_new] = reached.try_emplace(cell, Reached{length, before});
    if (!is_new && known->second.length <= length)
      return;
    known->second = {length, before};
    open.emplace(through, cell);
  }

  // Reaches the cells around a cell that are wide enough, also between their middles.
  // Cells at the rim of the map are never wide enough.
  void
  goOn(std::size_t cell, double length)
  {
    const auto columns = static_cast<std::ptrdiff_t>(map.raster_.columns);
    for (const std::ptrdiff_t dy : {-1, 0, 1})
      for (const std::ptrdiff_t dx : {-1, 0, 1}) {
        const auto next = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(cell) +
                                                   dy * columns + dx);
        if (next != cell && map.roomOf(next) >= radius + map.raster_.cell / 2)
          reach(next,
                cell,
                length + map.raster_.cell *
                             std::sqrt(static_cast<double>(dx * dx + dy * dy)));
      }
  }

  // \return whether a way exists
  bool
  run(std::size_t start, std::size_t goal)
  {
    reach(start, start, 0);
    while (!open.empty()) {
      const std::size_t cell = std::get<1>(open.top());
      open.pop();
      Reached& here = reached.at(cell);
      if (cell == goal)
        return true;
      if (!std::exchange(here.is_done, true))
        goOn(cell, here.length);
    }
    return false;
  }
};

std::vector<Eigen::Vector2d>
GroundMap::way(const Eigen::Vector2d& from,
               const Eigen::Vector2d& to,
               double radius,
               double longest) const
{
  if (isFree(from, to, radius))
    return {from, to};
  const auto start = cellAt(from);
  const auto goal = cellAt(to);
  if (!start || !goal || room(from) < radius || room(to) < radius)
    return {};
  Search search{*this, radius, longest, to};
  if (!search.run(*start, *goal))
    return {};
  std::vector<Eigen::Vector2d> corners = {to};
  for (std::size_t cell = *goal; cell != *start; cell = search.reached.at(cell).before)
    corners.push_back(middle(cell));
  corners.push_back(from);
  std::reverse(corners.begin(), corners.end());
  return straightened(corners, *this, radius);
}

} // namespace pcl6d
