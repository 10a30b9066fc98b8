// SPDX-License-Identifier: BSD-3-Clause
#include "objects/object_shape.h"
#include "rooms/plan_hull.h"
#include "rooms/storey_plan.h"

#include <pcl6d/common/portable_math.h>
#include <pcl6d/common/require.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace semantic_map;

namespace {
constexpr double kUpright = 0.7853981633974483; // [rad] steeper than 45 deg
constexpr double kHeadroom = 1;                 // [m] least from a floor to a ceiling
constexpr double kEyeBand = 0.6; // [m] above min_wall_height that a wall must reach
                                 // into

bool
isLabelled(const MapPlane& plane, PlaneLabel label)
{
  return plane.best().label == toString(label);
}

class RoomFinder {
public:
  RoomFinder(SemanticMap& map, const Points& floor_points, const RoomOptions& options)
  : map_(map)
  , floor_points_(floor_points)
  , options_(options)
  , R_plan_map_(levelling(map.up))
  {
    R_plan_map_ = headingAlign() * R_plan_map_;
    for (const auto& plane : map.planes)
      planes_.push_back(
          levelledPlane(plane.best(), R_plan_map_, Eigen::Vector3d::Zero()));
  }

  void
  find()
  {
    dropRooms();
    findStoreys();
    for (std::size_t i = 0; i < map_.storeys.size(); ++i)
      addRooms(i);
  }

private:
  // Turns the plan so that most walls are along its axes: the mean azimuth modulo 90
  // degrees, weighted by area.
  Eigen::Matrix3d
  headingAlign() const
  {
    double cosine = 0, sine = 0; // of four times the azimuth
    for (const auto& plane : map_.planes) {
      if (!isLabelled(plane, PlaneLabel::kWall))
        continue;
      const Eigen::Vector3d normal = R_plan_map_ * plane.best().normal;
      const Eigen::Vector2d n = normal.head<2>().normalized();
      const double c = n.x() * n.x() - n.y() * n.y(), s = 2 * n.x() * n.y();
      cosine += plane.best().area * (c * c - s * s);
      sine += plane.best().area * 2 * s * c;
    }
    const SinCos turn = portableSinCos(portableAtan2(sine, cosine) / 4);
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
    R.topLeftCorner<2, 2>() << turn.cos, turn.sin, -turn.sin, turn.cos;
    return R;
  }

  void
  dropRooms()
  {
    auto& relations = map_.relations;
    const auto isOfRoom = [](const MapRelation& relation) {
      return relation.first.kind == EntityKind::kRoom ||
             relation.second.kind == EntityKind::kRoom;
    };
    relations.erase(std::remove_if(relations.begin(), relations.end(), isOfRoom),
                    relations.end());
    map_.storeys.clear();
    map_.rooms.clear();
  }

  void
  findStoreys()
  {
    std::vector<std::size_t> floors;
    for (std::size_t i = 0; i < planes_.size(); ++i)
      if (isLabelled(map_.planes[i], PlaneLabel::kFloor) &&
          planes_[i].inclination < kUpright)
        floors.push_back(i);
    std::stable_sort(floors.begin(), floors.end(), [&](std::size_t a, std::size_t b) {
      return planes_[a].centre.z() < planes_[b].centre.z();
    });
    for (const auto i : floors) {
      const double height = planes_[i].centre.z();
      if (map_.storeys.empty() ||
          height - planes_[floors_of_.back().front()].centre.z() >
              options_.storey_height) {
        map_.storeys.emplace_back();
        floors_of_.emplace_back();
      }
      MapStorey& storey = map_.storeys.back();
      const double area = planes_[i].area;
      if (storey.area + area > 0)
        storey.floor += (height - storey.floor) * area / (storey.area + area);
      else
        storey.floor = height;
      storey.area += area;
      floors_of_.back().push_back(i);
    }
    for (std::size_t i = 0; i < map_.storeys.size(); ++i)
      findCeiling(i);
  }

  /** \return whether a floor of a storey is under the middle of a ceiling, or has its
   * own middle under the ceiling */
  bool
  isOverFloor(const ScenePlane& ceiling, std::size_t storey) const
  {
    return std::any_of(
        floors_of_[storey].begin(), floors_of_[storey].end(), [&](std::size_t i) {
          const ScenePlane& floor = planes_[i];
          return floor.centre.z() + kHeadroom < ceiling.centre.z() &&
                 (PlanHull(floor).contains(ceiling.centre.head<2>()) ||
                  PlanHull(ceiling).contains(floor.centre.head<2>()));
        });
  }

  // A ceiling over no floor is assigned by height. Where floors are on two levels side
  // by side, heights are ambiguous.
  bool
  isCeilingOf(std::size_t plane, std::size_t storey) const
  {
    const ScenePlane& ceiling = planes_[plane];
    if (!isLabelled(map_.planes[plane], PlaneLabel::kCeiling) ||
        ceiling.centre.z() <= map_.storeys[storey].floor + kHeadroom)
      return false;
    std::size_t highest = map_.storeys.size(); // with a floor under the ceiling
    for (std::size_t i = 0; i < map_.storeys.size(); ++i)
      if (isOverFloor(ceiling, i))
        highest = i;
    if (highest < map_.storeys.size())
      return storey == highest;
    return ceiling.centre.z() < topOf(storey) + options_.storey_height;
  }

  /** \return height of the next floor [m] */
  double
  topOf(std::size_t storey) const
  {
    return storey + 1 < map_.storeys.size() ? map_.storeys[storey + 1].floor
                                            : std::numeric_limits<double>::infinity();
  }

  void
  findCeiling(std::size_t storey)
  {
    double largest = 0;
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      if (!isCeilingOf(i, storey) || planes_[i].area <= largest)
        continue;
      largest = planes_[i].area;
      map_.storeys[storey].ceiling = planes_[i].centre.z();
    }
  }

  /** \return whether an upright plane is a wall of a storey: it must be present at eye
   * height */
  bool
  isUprightOf(std::size_t plane, std::size_t storey) const
  {
    const double low = map_.storeys[storey].floor + options_.min_wall_height;
    return planes_[plane].inclination > kUpright && planes_[plane].top >= low &&
           planes_[plane].bottom <= low + kEyeBand;
  }

  StoreyPlanes
  planesOf(std::size_t storey) const
  {
    StoreyPlanes planes;
    planes.floor = map_.storeys[storey].floor;
    for (const auto i : floors_of_[storey])
      planes.floors.push_back({i + 1, planes_[i]});
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      if (isCeilingOf(i, storey))
        planes.ceilings.push_back({i + 1, planes_[i]});
      if (!isUprightOf(i, storey))
        continue;
      if (isLabelled(map_.planes[i], PlaneLabel::kWall))
        planes.walls.push_back({i + 1, planes_[i]});
      if (isLabelled(map_.planes[i], PlaneLabel::kDoor))
        planes.doors.push_back({i + 1, planes_[i]});
    }
    for (const auto& point : floor_points_) {
      const Eigen::Vector3d p =
          R_plan_map_ * (point.cast<double>() + map_.world_offset);
      if (std::abs(p.z() - planes.floor) <= options_.storey_height)
        planes.seen.emplace_back(p.head<2>());
    }
    return planes;
  }

  void
  addRooms(std::size_t storey)
  {
    const std::size_t first = map_.rooms.size() + 1; // id
    const std::vector<PlanRoom> rooms = roomsOf(planesOf(storey), options_);
    for (const PlanRoom& room : rooms) {
      MapRoom& added = map_.rooms.emplace_back();
      added.storey = storey + 1;
      added.area = room.area;
      added.height = room.height;
      for (const auto& corner : room.outline)
        added.outline.push_back(
            R_plan_map_.transpose() *
            Eigen::Vector3d(corner.x(), corner.y(), map_.storeys[storey].floor));
      const Entity entity{EntityKind::kRoom, map_.rooms.size()};
      for (const auto plane : room.planes)
        map_.relations.push_back({{EntityKind::kPlane, plane}, "belongs_to", entity});
      for (const auto neighbour : room.neighbours)
        if (first + neighbour > entity.id)
          map_.relations.push_back(
              {entity, "next_to", {EntityKind::kRoom, first + neighbour}});
    }
  }

  SemanticMap& map_;
  const Points& floor_points_;
  const RoomOptions& options_;
  Eigen::Matrix3d R_plan_map_;
  std::vector<ScenePlane> planes_;
  std::vector<std::vector<std::size_t>> floors_of_; // planes of each storey
};
} // namespace

void
RoomOptions::validate() const
{
  require(storey_height > 0, "storey_height", storey_height, "> 0 [m]");
  require(cell > 0, "cell", cell, "> 0 [m]");
  require(min_wall_height > 0, "min_wall_height", min_wall_height, "> 0 [m]");
  require(max_gap >= 0, "max_gap", max_gap, ">= 0 [m]");
  require(max_door >= 0, "max_door", max_door, ">= 0 [m]");
  require(min_width > 0, "min_width", min_width, "> 0 [m]");
  require(min_area >= 0, "min_area", min_area, ">= 0 [m^2]");
  require(min_seen >= 0 && min_seen <= 1, "min_seen", min_seen, "in [0, 1]");
}

void
findRooms(SemanticMap& map, const Points& floor_points, const RoomOptions& options)
{
  options.validate();
  RoomFinder(map, floor_points, options).find();
}

} // namespace pcl6d
