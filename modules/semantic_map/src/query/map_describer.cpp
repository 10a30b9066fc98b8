// SPDX-License-Identifier: BSD-3-Clause
#include "query/map_describer.h"

#include <algorithm>
#include <limits>

namespace pcl6d::semantic_map {
namespace {
using Things = std::vector<Entity>;

constexpr bool kInTable = true;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN(); // equals no value

template <typename Elements, typename Neighbours>
void
addSeen(EntityKind kind, const Elements& elements, Neighbours& seen)
{
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (const auto scan : elements[i].scans)
      seen[{EntityKind::kScan, scan}].push_back({kind, i + 1});
}

Property
number(const char* name, double value, bool in_table = false)
{
  return {name, value, {}, in_table};
}

Property
number(const char* name, std::size_t value, bool in_table = false)
{
  return {name, static_cast<double>(value), {}, in_table};
}

Property
text(const char* name, const std::string& value, bool in_table = false)
{
  return {name, value, {}, in_table};
}

void
addPosition(Properties& properties, const Eigen::Vector3d& position)
{
  properties.push_back(number("x", position.x(), kInTable));
  properties.push_back(number("y", position.y(), kInTable));
  properties.push_back(number("z", position.z(), kInTable));
}

Eigen::Vector3d
meanOf(const std::vector<Eigen::Vector3d>& corners)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& corner : corners)
    mean += corner / static_cast<double>(corners.size());
  return mean;
}

Things
find(const std::map<Entity, Things>& neighbours, const Entity& entity)
{
  const auto found = neighbours.find(entity);
  return found == neighbours.end() ? Things() : found->second;
}

/** \return the entities of a kind with these ids, without the id 0 of a storey */
Things
things(EntityKind kind, const std::vector<std::size_t>& ids)
{
  Things all;
  for (const auto id : ids)
    if (id != 0 || kind == EntityKind::kScan)
      all.push_back({kind, id});
  return all;
}

Things
ofKind(const Things& all, EntityKind kind, bool wanted)
{
  Things chosen;
  for (const auto& entity : all)
    if ((entity.kind == kind) == wanted)
      chosen.push_back(entity);
  return chosen;
}
} // namespace

MapDescriber::MapDescriber(const SemanticMap& map) : map_(map)
{
  for (const auto& relation : map.relations) {
    forward_[relation.predicate][relation.first].push_back(relation.second);
    backward_[relation.predicate][relation.second].push_back(relation.first);
  }
  addSeen(EntityKind::kPlane, map.planes, seen_);
  addSeen(EntityKind::kObject, map.objects, seen_);
}

MapDescriber::Things
MapDescriber::targets(const std::string& predicate, const Entity& entity) const
{
  const auto found = forward_.find(predicate);
  return found == forward_.end() ? Things() : find(found->second, entity);
}

MapDescriber::Things
MapDescriber::sources(const std::string& predicate, const Entity& entity) const
{
  const auto found = backward_.find(predicate);
  return found == backward_.end() ? Things() : find(found->second, entity);
}

MapDescriber::Things
MapDescriber::both(const std::string& predicate, const Entity& entity) const
{
  Things all = targets(predicate, entity);
  for (const auto& other : sources(predicate, entity))
    all.push_back(other);
  std::sort(all.begin(), all.end());
  return all;
}

MapDescriber::Things
MapDescriber::storeyOf(const Things& rooms, const Eigen::Vector3d& position) const
{
  const std::size_t storey = rooms.empty() ? storeyAt(map_, map_.up.dot(position))
                                           : map_.rooms[rooms.front().id - 1].storey;
  return things(EntityKind::kStorey, {storey});
}

Properties
MapDescriber::scan(std::size_t place) const
{
  const MapScan& scan = map_.scans[place];
  const Eigen::Vector3d position = scan.T_world_scan.translation();
  Things linked, rooms;
  for (const auto& link : map_.links)
    if (link.from == scan.id || link.to == scan.id)
      linked.push_back({EntityKind::kScan, link.from == scan.id ? link.to : link.from});
  if (const std::size_t room = roomAt(map_, position))
    rooms.push_back({EntityKind::kRoom, room});
  Properties properties{number("id", scan.id, kInTable),
                        text("file", scan.file, kInTable)};
  addPosition(properties, position);
  properties.push_back({"room", rooms, EntityKind::kRoom, kInTable});
  properties.push_back({"storey", storeyOf(rooms, position), EntityKind::kStorey});
  properties.push_back(
      {"seen", find(seen_, {EntityKind::kScan, scan.id}), EntityKind::kObject});
  properties.push_back({"linked", linked, EntityKind::kScan});
  return properties;
}

Properties
MapDescriber::plane(std::size_t place) const
{
  const Plane& plane = map_.planes[place].best();
  const Entity self{EntityKind::kPlane, place + 1};
  const Eigen::Vector3d centre = plane.hull.empty()
                                     ? Eigen::Vector3d(plane.offset * plane.normal)
                                     : meanOf(plane.hull);
  const Things rooms = targets("belongs_to", self);
  Properties properties{number("id", self.id, kInTable),
                        text("label", plane.label, kInTable),
                        number("area", plane.area, kInTable),
                        number("inliers", plane.inliers, kInTable),
                        number("rms", plane.rms)};
  addPosition(properties, centre);
  properties.push_back({"room", rooms, EntityKind::kRoom, kInTable});
  properties.push_back({"storey", storeyOf(rooms, centre), EntityKind::kStorey});
  for (const char* const predicate :
       {"parallel", "orthogonal", "equalheight", "onto", "touches"})
    properties.push_back({predicate, both(predicate, self), EntityKind::kPlane});
  properties.push_back({"above", targets("above", self), EntityKind::kPlane});
  properties.push_back({"under", sources("above", self), EntityKind::kPlane});
  properties.push_back({"in", targets("in", self), EntityKind::kObject});
  properties.push_back({"carries", sources("on", self), EntityKind::kObject});
  properties.push_back({"next_to", sources("next_to", self), EntityKind::kObject});
  properties.push_back(
      {"seen", things(EntityKind::kScan, map_.planes[place].scans), EntityKind::kScan});
  return properties;
}

Properties
MapDescriber::object(std::size_t place) const
{
  const MapObject& object = map_.objects[place];
  const ObjectPose& pose = object.pose;
  const Entity self{EntityKind::kObject, place + 1};
  const Eigen::Vector3d position = pose.T_world_object.translation();
  const Eigen::Vector3d size = pose.box.sizes();
  const Things inside = targets("in", self);
  const Things rooms = ofKind(inside, EntityKind::kRoom, true);
  Properties properties{number("id", self.id, kInTable),
                        text("class", pose.object_class, kInTable),
                        number("score", object.score, kInTable)};
  addPosition(properties, position);
  properties.push_back({"room", rooms, EntityKind::kRoom, kInTable});
  properties.push_back({"storey", storeyOf(rooms, position), EntityKind::kStorey});
  properties.push_back({"on", targets("on", self), EntityKind::kPlane, kInTable});
  properties.push_back(
      {"in", ofKind(inside, EntityKind::kRoom, false), EntityKind::kObject});
  properties.push_back({"next_to", both("next_to", self), EntityKind::kObject});
  properties.push_back({"above", targets("above", self), EntityKind::kObject});
  properties.push_back({"under", sources("above", self), EntityKind::kObject});
  properties.push_back({"carries", sources("on", self), EntityKind::kObject});
  properties.push_back({"has", sources("in", self), EntityKind::kObject});
  properties.push_back(
      {"seen", things(EntityKind::kScan, object.scans), EntityKind::kScan});
  for (const auto& [name, value] :
       {std::pair{"length", size.x()}, {"width", size.y()}, {"height", size.z()}})
    properties.push_back(number(name, value));
  properties.push_back(number("points", pose.points));
  properties.push_back(text("moves", pose.moves ? "yes" : "no"));
  return properties;
}

Properties
MapDescriber::room(std::size_t place) const
{
  const MapRoom& room = map_.rooms[place];
  const Entity self{EntityKind::kRoom, place + 1};
  Things has = sources("in", self);
  for (const auto& plane : sources("belongs_to", self))
    has.push_back(plane);
  Properties properties{number("id", self.id, kInTable),
                        number("area", room.area, kInTable),
                        number("height", room.height.value_or(kUnknown), kInTable)};
  addPosition(properties, centreOf(room, map_.up));
  properties.push_back({"storey",
                        things(EntityKind::kStorey, {room.storey}),
                        EntityKind::kStorey,
                        kInTable});
  properties.push_back({"has", has, EntityKind::kObject});
  properties.push_back({"next_to", both("next_to", self), EntityKind::kRoom, kInTable});
  return properties;
}

Properties
MapDescriber::storey(std::size_t place) const
{
  const MapStorey& storey = map_.storeys[place];
  Things rooms;
  for (std::size_t i = 0; i < map_.rooms.size(); ++i)
    if (map_.rooms[i].storey == place + 1)
      rooms.push_back({EntityKind::kRoom, i + 1});
  const double height = storey.ceiling.value_or(kUnknown) - storey.floor;
  return {number("id", place + 1, kInTable),
          number("floor", storey.floor, kInTable),
          number("height", height, kInTable),
          number("area", storey.area, kInTable),
          {"has", rooms, EntityKind::kRoom, kInTable}};
}

Properties
MapDescriber::link(std::size_t place) const
{
  const MapLink& link = map_.links[place];
  return {{"from", things(EntityKind::kScan, {link.from}), EntityKind::kScan, kInTable},
          {"to", things(EntityKind::kScan, {link.to}), EntityKind::kScan, kInTable},
          text("kind", link.kind, kInTable),
          number("pairs", link.pairs, kInTable),
          number("rms", link.rms, kInTable)};
}

Properties
MapDescriber::relation(std::size_t place) const
{
  const MapRelation& relation = map_.relations[place];
  return {{"first", Things{relation.first}, relation.first.kind, kInTable},
          text("predicate", relation.predicate, kInTable),
          {"second", Things{relation.second}, relation.second.kind, kInTable}};
}

} // namespace pcl6d::semantic_map
