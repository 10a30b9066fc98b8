// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/polygon.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <algorithm>

namespace pcl6d {
namespace {
std::size_t
sizeOf(const SemanticMap& map, EntityKind kind)
{
  switch (kind) {
  case EntityKind::kPlane:
    return map.planes.size();
  case EntityKind::kObject:
    return map.objects.size();
  case EntityKind::kRoom:
    return map.rooms.size();
  case EntityKind::kStorey:
    return map.storeys.size();
  case EntityKind::kScan:
    break;
  }
  return map.scans.size();
}

void
addOnce(std::vector<std::string>& names, const std::string& name)
{
  if (std::find(names.begin(), names.end(), name) == names.end())
    names.push_back(name);
}
} // namespace

std::optional<std::size_t>
SemanticMap::placeOf(const Entity& entity) const
{
  if (entity.kind == EntityKind::kScan) {
    const auto scan = std::lower_bound(
        scans.begin(), scans.end(), entity.id, [](const MapScan& s, std::size_t id) {
          return s.id < id;
        });
    if (scan == scans.end() || scan->id != entity.id)
      return {};
    return static_cast<std::size_t>(scan - scans.begin());
  }
  if (entity.id == 0 || entity.id > sizeOf(*this, entity.kind))
    return {};
  return entity.id - 1;
}

std::vector<std::string>
SemanticMap::labelNames() const
{
  std::vector<std::string> names;
  for (const auto label : {PlaneLabel::kNone,
                           PlaneLabel::kFloor,
                           PlaneLabel::kCeiling,
                           PlaneLabel::kWall,
                           PlaneLabel::kDoor})
    names.emplace_back(toString(label));
  for (const auto& plane : planes)
    addOnce(names, plane.best().label);
  for (const auto& object : objects)
    addOnce(names, object.pose.object_class);
  return names;
}

bool
isInPlan(const MapRoom& room, const Eigen::Vector3d& up, const Eigen::Vector3d& point)
{
  const Eigen::Vector3d x = up.unitOrthogonal(), y = up.cross(x);
  std::vector<Eigen::Vector2d> ring; // about the point
  for (const auto& corner : room.outline)
    ring.emplace_back(x.dot(corner - point), y.dot(corner - point));
  return isInside(ring, Eigen::Vector2d::Zero());
}

Eigen::Vector3d
centreOf(const MapRoom& room, const Eigen::Vector3d& up)
{
  if (room.outline.empty())
    return Eigen::Vector3d::Zero();
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero(); // from the first corner
  double twice_area = 0;
  for (std::size_t i = 2; i < room.outline.size(); ++i) {
    const Eigen::Vector3d u = room.outline[i - 1] - room.outline[0];
    const Eigen::Vector3d v = room.outline[i] - room.outline[0];
    const double area = up.dot(u.cross(v)); // signed: the outline may be hollow
    twice_area += area;
    weighted += area / 3 * (u + v);
  }
  if (!(twice_area > 0))
    return room.outline[0];
  return room.outline[0] + weighted / twice_area;
}

std::size_t
roomAt(const SemanticMap& map, const Eigen::Vector3d& point, double tolerance)
{
  const auto floorOf = [&](std::size_t room) {
    return map.storeys[map.rooms[room - 1].storey - 1].floor;
  };
  const double height = map.up.dot(point);
  std::size_t best = 0;
  for (std::size_t id = 1; id <= map.rooms.size(); ++id)
    if (floorOf(id) <= height + tolerance &&
        (best == 0 || floorOf(id) > floorOf(best)) &&
        isInPlan(map.rooms[id - 1], map.up, point))
      best = id;
  return best;
}

std::size_t
storeyAt(const SemanticMap& map, double height, double tolerance)
{
  std::size_t storey = map.storeys.empty() ? 0 : 1;
  while (storey < map.storeys.size() && map.storeys[storey].floor <= height + tolerance)
    ++storey;
  return storey;
}

} // namespace pcl6d
