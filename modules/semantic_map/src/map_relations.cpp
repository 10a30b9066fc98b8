// SPDX-License-Identifier: BSD-3-Clause
#include "objects/object_shape.h"

#include <pcl6d/common/require.h>
#include <pcl6d/semantic_map/map_relations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace pcl6d {
using namespace semantic_map;

namespace {
constexpr std::array<Relation, 6> kPlaneRelations{Relation::kParallel,
                                                  Relation::kOrthogonal,
                                                  Relation::kEqualHeight,
                                                  Relation::kOnto,
                                                  Relation::kTouches,
                                                  Relation::kAbove};
constexpr double kUpright = 0.7853981633974483; // [rad] steeper than 45 deg
constexpr double kOpenAbove = 3;                // [m] of a room without a ceiling

Entity
planeEntity(std::size_t place)
{
  return {EntityKind::kPlane, place + 1};
}

Entity
objectEntity(std::size_t place)
{
  return {EntityKind::kObject, place + 1};
}

class RelationFinder {
public:
  RelationFinder(const SemanticMap& map, const MapRelationOptions& options)
  : map_(map), options_(options), R_level_map_(levelling(map.up))
  {
    for (const auto& plane : map.planes) {
      planes_.push_back(
          levelledPlane(plane.best(), R_level_map_, Eigen::Vector3d::Zero()));
      Eigen::AlignedBox3d& bounds = bounds_.emplace_back();
      for (const auto& corner : planes_.back().corners)
        bounds.extend(corner);
    }
    for (const auto& object : map.objects)
      shapes_.push_back(shapeOf(object.pose, R_level_map_));
  }

  std::vector<MapRelation>
  find()
  {
    for (const auto& relation : map_.relations)
      if (relation.first.kind == EntityKind::kRoom ||
          relation.predicate == "belongs_to")
        relations_.push_back(relation);
    relatePlanes();
    for (std::size_t i = 0; i < shapes_.size(); ++i) {
      findParts(i);
      findSupport(i);
      findRoom(i);
      findWalls(i);
      for (std::size_t j = 0; j < shapes_.size(); ++j)
        if (i != j)
          relateObjects(i, j);
    }
    sort();
    return std::move(relations_);
  }

private:
  void
  add(const Entity& first, const char* predicate, const Entity& second)
  {
    relations_.push_back({first, predicate, second});
  }

  bool
  isLabelled(std::size_t plane) const
  {
    return map_.planes[plane].best().label != "none";
  }

  void
  relatePlanes()
  {
    for (std::size_t i = 0; i < planes_.size(); ++i)
      for (std::size_t j = i + 1; j < planes_.size(); ++j)
        if (isLabelled(i) && isLabelled(j) &&
            bounds_[i].exteriorDistance(bounds_[j]) <= options_.reach)
          relatePlanes(i, j);
  }

  void
  relatePlanes(std::size_t i, std::size_t j)
  {
    for (const Relation relation : kPlaneRelations)
      if (holds(relation, planes_[i], planes_[j], options_.planes))
        add(planeEntity(i), toString(relation), planeEntity(j));
      else if (relation == Relation::kAbove &&
               holds(relation, planes_[j], planes_[i], options_.planes))
        add(planeEntity(j), toString(relation), planeEntity(i));
  }

  /** \return whether a plane is a part of an object: entirely in its box */
  bool
  isPart(std::size_t plane, std::size_t object) const
  {
    const auto& hull = map_.planes[plane].best().hull;
    return !hull.empty() && std::all_of(hull.begin(), hull.end(), [&](const auto& p) {
      return isInBox(map_.objects[object].pose, p, options_.on);
    });
  }

  /** \return whether the box of an object lies in the box of another object */
  bool
  isInside(const ObjectPose& inner, const ObjectPose& outer) const
  {
    for (int i = 0; i < 8; ++i)
      if (!isInBox(
              outer,
              inner.T_world_object *
                  inner.box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)),
              options_.on))
        return false;
    return true;
  }

  void
  findParts(std::size_t object)
  {
    for (std::size_t i = 0; i < planes_.size(); ++i)
      if (isPart(i, object))
        add(planeEntity(i), "in", objectEntity(object));
  }

  /** \return distance [m] of the foot of an object to a level plane below it; infinite
   * if the foot is not over the plane */
  double
  gapTo(std::size_t plane, const ObjectShape& shape) const
  {
    const ScenePlane& level = planes_[plane];
    if (level.inclination > options_.planes.angle ||
        !overlapInPlan(level, shape.foot, options_.on))
      return std::numeric_limits<double>::infinity();
    const Eigen::Vector3d way = shape.foot.centre - level.centre;
    return std::abs(way.dot(level.normal) / level.normal.z());
  }

  // Labelled planes first: the underside of a box is no floor.
  void
  findSupport(std::size_t object)
  {
    std::optional<std::size_t> support;
    double smallest = options_.on;
    for (const bool labelled : {true, false}) {
      for (std::size_t i = 0; i < planes_.size(); ++i) {
        const double gap = gapTo(i, shapes_[object]);
        if (isLabelled(i) != labelled || gap > smallest || isPart(i, object))
          continue;
        if (support && gap == smallest)
          continue;
        support = i;
        smallest = gap;
      }
      if (support)
        break;
    }
    if (!support)
      return;
    add(objectEntity(object), "on", planeEntity(*support));
    for (std::size_t j = 0; j < shapes_.size(); ++j)
      if (j != object && isPart(*support, j) && !isOnTop(object, j))
        add(objectEntity(object), "on", objectEntity(j));
  }

  bool
  isOnTop(std::size_t i, std::size_t j) const
  {
    return overlapInPlan(shapes_[j].footprint, shapes_[i].foot) &&
           std::abs(shapes_[i].bottom - shapes_[j].top) <= options_.on;
  }

  void
  findRoom(std::size_t object)
  {
    const double bottom = shapes_[object].bottom;
    const Eigen::Vector3d foot = R_level_map_.transpose() * shapes_[object].foot.centre;
    for (std::size_t i = 0; i < map_.rooms.size(); ++i) {
      const MapRoom& room = map_.rooms[i];
      const double floor = map_.storeys[room.storey - 1].floor;
      if (bottom >= floor - options_.planes.height &&
          bottom <= floor + room.height.value_or(kOpenAbove) &&
          isInPlan(room, map_.up, foot))
        add(objectEntity(object), "in", {EntityKind::kRoom, i + 1});
    }
  }

  void
  findWalls(std::size_t object)
  {
    const ObjectShape& shape = shapes_[object];
    for (std::size_t i = 0; i < planes_.size(); ++i)
      if (isLabelled(i) && planes_[i].inclination > kUpright &&
          planes_[i].bottom < shape.top && planes_[i].top > shape.bottom &&
          hullDistance(flattened(planes_[i]), shape.footprint) <= options_.next_to)
        add(objectEntity(object), "next_to", planeEntity(i));
  }

  void
  relateObjects(std::size_t i, std::size_t j)
  {
    const ObjectShape &a = shapes_[i], &b = shapes_[j];
    const ObjectPose &of_i = map_.objects[i].pose, &of_j = map_.objects[j].pose;
    if (isOnTop(i, j))
      add(objectEntity(i), "on", objectEntity(j));
    else if (a.bottom >= b.top && overlapInPlan(a.footprint, b.footprint))
      add(objectEntity(i), "above", objectEntity(j));
    else if (of_i.box.volume() < of_j.box.volume() && isInside(of_i, of_j))
      add(objectEntity(i), "in", objectEntity(j));
    else if (i < j && !isOnTop(j, i) && !isInside(of_j, of_i) && a.bottom < b.top &&
             b.bottom < a.top &&
             hullDistance(a.footprint, b.footprint) <= options_.next_to)
      add(objectEntity(i), "next_to", objectEntity(j));
  }

  void
  sort()
  {
    const auto& names = mapPredicates();
    const auto rank = [&](const MapRelation& relation) {
      return std::find(names.begin(), names.end(), relation.predicate) - names.begin();
    };
    std::stable_sort(relations_.begin(),
                     relations_.end(),
                     [&](const MapRelation& a, const MapRelation& b) {
                       return std::make_tuple(a.first, rank(a), a.second) <
                              std::make_tuple(b.first, rank(b), b.second);
                     });
  }

  const SemanticMap& map_;
  const MapRelationOptions& options_;
  Eigen::Matrix3d R_level_map_;
  std::vector<ScenePlane> planes_;
  std::vector<Eigen::AlignedBox3d> bounds_; // of the planes
  std::vector<ObjectShape> shapes_;         // of the objects
  std::vector<MapRelation> relations_;
};
} // namespace

void
MapRelationOptions::validate() const
{
  planes.validate();
  require(reach > 0, "reach", reach, "> 0 [m]");
  require(on > 0, "on", on, "> 0 [m]");
  require(next_to > 0, "next_to", next_to, "> 0 [m]");
}

std::vector<MapRelation>
findRelations(const SemanticMap& map, const MapRelationOptions& options)
{
  options.validate();
  return RelationFinder(map, options).find();
}

const std::vector<std::string>&
mapPredicates()
{
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Relation relation : kPlaneRelations)
      all.emplace_back(toString(relation));
    for (const char* const name : {"on", "in", "next_to", "belongs_to"})
      all.emplace_back(name);
    return all;
  }();
  return names;
}

} // namespace pcl6d
