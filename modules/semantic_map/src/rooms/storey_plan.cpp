// SPDX-License-Identifier: BSD-3-Clause
#include "rooms/plan_hull.h"
#include "rooms/storey_plan.h"

#include <pcl6d/common/polygon.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace pcl6d::semantic_map {
namespace {
double
areaOf(const std::vector<Eigen::Vector2d>& outline)
{
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i)
    twice += cross(outline[i], outline[(i + 1) % outline.size()]);
  return twice / 2;
}

class StoreyPlan {
public:
  StoreyPlan(const StoreyPlanes& storey, const RoomOptions& options)
  : storey_(storey), options_(options), grid_(boundsOf(storey), options.cell)
  {
    for (const auto& wall : storey.walls)
      walls_.push_back(planLine(wall.shape));
    doorways_ = doorways(walls_, options.max_door);
    for (const auto& door : openDoors(walls_, storey.seen, options.max_door))
      doorways_.push_back(door);
    joinCorners(walls_, options.max_gap);
    for (const auto& door : storey.doors)
      doors_.push_back(planLine(door.shape));
    for (const auto* const lines : {&walls_, &doorways_, &doors_})
      for (const auto& line : *lines)
        grid_.addLine(line);
  }

  std::vector<PlanRoom>
  find()
  {
    std::vector<PlanHull> floors;
    for (const auto& floor : storey_.floors)
      floors.emplace_back(floor.shape);
    const std::int32_t num_parts = grid_.findParts([&](const Eigen::Vector2d& point) {
      return std::any_of(floors.begin(), floors.end(), [&](const PlanHull& floor) {
        return floor.contains(point);
      });
    });
    chooseRooms(num_parts);
    for (std::size_t i = 0; i < rooms_.size(); ++i)
      rooms_[i].outline = grid_.outline(static_cast<std::int32_t>(i));
    for (auto& room : rooms_)
      room.area = areaOf(room.outline);
    findLevelPlanes();
    findWalls();
    findNeighbours();
    return std::move(rooms_);
  }

private:
  static Eigen::AlignedBox2d
  boundsOf(const StoreyPlanes& storey)
  {
    Eigen::AlignedBox2d bounds;
    for (const auto& floor : storey.floors)
      for (const auto& corner : floor.shape.corners)
        bounds.extend(Eigen::Vector2d(corner.head<2>()));
    return bounds;
  }

  /** \return the squares of 25 cm with a floor point */
  std::set<std::pair<long, long>>
  seenSquares() const
  {
    std::set<std::pair<long, long>> seen;
    for (const auto& point : storey_.seen)
      seen.insert(squareOf(point));
    return seen;
  }

  static std::pair<long, long>
  squareOf(const Eigen::Vector2d& point)
  {
    constexpr double kSquare = 0.25; // [m]
    return {std::lround(std::floor(point.x() / kSquare)),
            std::lround(std::floor(point.y() / kSquare))};
  }

  // Parts that are rooms get the labels 0, 1, ... by falling size, other parts no
  // label.
  void
  chooseRooms(std::int32_t num_parts)
  {
    const auto count = static_cast<std::size_t>(num_parts);
    std::vector<std::size_t> cells(count, 0), seen(count, 0);
    const auto squares = seenSquares();
    for (std::size_t i = 0; i < grid_.numCells(); ++i) {
      if (grid_.label(i) < 0)
        continue;
      const auto part = static_cast<std::size_t>(grid_.label(i));
      ++cells[part];
      seen[part] += squares.count(squareOf(grid_.centre(i)));
    }
    const std::vector<std::size_t> squares_inside = grid_.largestSquares(num_parts);
    const double cell = grid_.cell();
    std::vector<std::size_t> order;
    for (std::size_t part = 0; part < count; ++part)
      if (static_cast<double>(cells[part]) * cell * cell >= options_.min_area &&
          static_cast<double>(squares_inside[part]) * cell >=
              options_.min_width - cell &&
          (squares.empty() || static_cast<double>(seen[part]) >=
                                  options_.min_seen * static_cast<double>(cells[part])))
        order.push_back(part);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return cells[a] > cells[b];
    });
    std::vector<std::int32_t> label_of(count, PlanGrid::kNoRoom);
    for (std::size_t i = 0; i < order.size(); ++i) {
      label_of[order[i]] = static_cast<std::int32_t>(i);
      cells_.push_back(cells[order[i]]);
    }
    for (std::size_t i = 0; i < grid_.numCells(); ++i)
      if (grid_.label(i) >= 0)
        grid_.setLabel(i, label_of[static_cast<std::size_t>(grid_.label(i))]);
    rooms_.resize(order.size());
  }

  /** \return per room the number of its cells covered by a level plane */
  std::vector<std::size_t>
  cover(const ScenePlane& plane) const
  {
    const PlanHull hull(plane);
    std::vector<std::size_t> covered(rooms_.size(), 0);
    for (std::size_t i = 0; i < grid_.numCells(); ++i)
      if (grid_.label(i) >= 0 && hull.contains(grid_.centre(i)))
        ++covered[static_cast<std::size_t>(grid_.label(i))];
    return covered;
  }

  // A level plane belongs to a room if it covers a twentieth of the room. The ceiling
  // that covers most determines the room's height.
  void
  findLevelPlanes()
  {
    constexpr std::size_t kShare = 20;
    for (const auto& floor : storey_.floors) {
      const auto covered = cover(floor.shape);
      for (std::size_t i = 0; i < rooms_.size(); ++i)
        if (covered[i] * kShare >= cells_[i])
          rooms_[i].planes.push_back(floor.id);
    }
    std::vector<std::size_t> most(rooms_.size(), 0);
    for (const auto& ceiling : storey_.ceilings) {
      const auto covered = cover(ceiling.shape);
      for (std::size_t i = 0; i < rooms_.size(); ++i) {
        if (covered[i] * kShare < cells_[i])
          continue;
        rooms_[i].planes.push_back(ceiling.id);
        if (covered[i] <= most[i])
          continue;
        most[i] = covered[i];
        rooms_[i].height = ceiling.shape.centre.z() - storey_.floor;
      }
    }
  }

  /** \return the points of a line, one per cell */
  std::vector<Eigen::Vector2d>
  samples(const PlanLine& line) const
  {
    const auto count =
        static_cast<std::size_t>(std::ceil(line.length() / grid_.cell())) + 1;
    std::vector<Eigen::Vector2d> points;
    for (std::size_t i = 0; i < count; ++i)
      points.push_back(
          line.at((static_cast<double>(i) + 0.5) / static_cast<double>(count)));
    return points;
  }

  // A wall belongs to rooms that touch at least 25 cm, or half, of it.
  void
  findWalls()
  {
    constexpr double kLength = 0.25; // [m]
    for (const auto& plane : storey_.walls) {
      const PlanLine line = planLine(plane.shape);
      const auto points = samples(line);
      const Eigen::Vector2d along = (line.to - line.from).normalized();
      const Eigen::Vector2d aside =
          0.75 * grid_.cell() * Eigen::Vector2d(-along.y(), along.x());
      std::vector<std::size_t> touched(rooms_.size(), 0);
      for (const auto& point : points) {
        const std::int32_t left = grid_.labelAt(point + aside);
        const std::int32_t right = grid_.labelAt(point - aside);
        if (left >= 0)
          ++touched[static_cast<std::size_t>(left)];
        if (right >= 0 && right != left)
          ++touched[static_cast<std::size_t>(right)];
      }
      const double step = line.length() / static_cast<double>(points.size());
      for (std::size_t room = 0; room < rooms_.size(); ++room)
        if (touched[room] > 0 && static_cast<double>(touched[room]) * step >=
                                     std::min(kLength, line.length() / 2))
          rooms_[room].planes.push_back(plane.id);
    }
  }

  /** \return the distance of each room to a line, if at most 0.35 m: the thickness of a
   * wall plus the protrusion of a door */
  std::map<std::size_t, double>
  roomsNear(const PlanLine& line) const
  {
    constexpr double kReach = 0.35; // [m]
    const auto steps = static_cast<int>(std::ceil(kReach / grid_.cell()));
    std::map<std::size_t, double> distances;
    for (const auto& point : samples(line))
      for (int y = -steps; y <= steps; ++y)
        for (int x = -steps; x <= steps; ++x) {
          const Eigen::Vector2d way = grid_.cell() * Eigen::Vector2d(x, y);
          const std::int32_t label = grid_.labelAt(point + way);
          if (label < 0 || way.norm() > kReach)
            continue;
          const auto known =
              distances.emplace(static_cast<std::size_t>(label), way.norm()).first;
          known->second = std::min(known->second, way.norm());
        }
    return distances;
  }

  /** \return the rooms nearest to a line, at most two, the nearest first */
  std::vector<std::size_t>
  roomsAt(const PlanLine& line) const
  {
    std::vector<std::pair<double, std::size_t>> near;
    for (const auto& [room, distance] : roomsNear(line))
      near.emplace_back(distance, room);
    std::sort(near.begin(), near.end());
    std::vector<std::size_t> rooms;
    for (std::size_t i = 0; i < std::min<std::size_t>(near.size(), 2); ++i)
      rooms.push_back(near[i].second);
    return rooms;
  }

  // A door joins, and belongs to, its two nearest rooms.
  void
  findNeighbours()
  {
    std::vector<std::set<std::size_t>> neighbours(rooms_.size());
    const auto join = [&](const std::vector<std::size_t>& rooms) {
      if (rooms.size() < 2)
        return;
      neighbours[rooms[0]].insert(rooms[1]);
      neighbours[rooms[1]].insert(rooms[0]);
    };
    for (std::size_t i = 0; i < doors_.size(); ++i) {
      const auto rooms = roomsAt(doors_[i]);
      join(rooms);
      for (const auto room : rooms)
        rooms_[room].planes.push_back(storey_.doors[i].id);
    }
    for (const auto& gap : doorways_)
      join(roomsAt(gap));
    for (std::size_t i = 0; i < rooms_.size(); ++i) {
      rooms_[i].neighbours.assign(neighbours[i].begin(), neighbours[i].end());
      std::sort(rooms_[i].planes.begin(), rooms_[i].planes.end());
    }
  }

  const StoreyPlanes& storey_;
  const RoomOptions& options_;
  PlanGrid grid_;
  std::vector<PlanLine> walls_;
  std::vector<PlanLine> doorways_; // gaps of walls, and open doors in walls
  std::vector<PlanLine> doors_;
  std::vector<PlanRoom> rooms_;
  std::vector<std::size_t> cells_; // of each room
};
} // namespace

std::vector<PlanRoom>
roomsOf(const StoreyPlanes& storey, const RoomOptions& options)
{
  return StoreyPlan(storey, options).find();
}

} // namespace pcl6d::semantic_map
