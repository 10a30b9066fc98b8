// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/pose.h>
#include <pcl6d/semantic_map/semantic_map.h>

#include <string>
#include <vector>

/** \file Hand-made scenes with known answers. */
namespace pcl6d::test {

/** \brief A rectangle with the corners p, p + u, p + u + v, p + v. */
inline Plane
rectangle(const std::string& label,
          const Eigen::Vector3d& p,
          const Eigen::Vector3d& u,
          const Eigen::Vector3d& v)
{
  Plane plane;
  plane.normal = u.cross(v).normalized();
  plane.offset = plane.normal.dot(p);
  plane.label = label;
  plane.area = u.norm() * v.norm();
  plane.hull = {p, p + u, p + u + v, p + v};
  plane.inliers = 100;
  orientPlane(plane);
  return plane;
}

/** \brief An upright wall over the line from a to b, from the floor to the given height. */
inline Plane
wall(const Eigen::Vector2d& a,
     const Eigen::Vector2d& b,
     double floor = 0,
     double height = 2.5,
     const std::string& label = "wall")
{
  return rectangle(
      label, {a.x(), a.y(), floor}, {b.x() - a.x(), b.y() - a.y(), 0}, {0, 0, height});
}

/** \brief An object that stands at a place, its box centred about the z axis. */
inline MapObject
object(const std::string& object_class,
       const Eigen::Vector3d& foot,
       const Eigen::Vector3d& size,
       double heading = 0)
{
  MapObject made;
  made.pose.object_class = object_class;
  made.pose.T_world_object = planarPose(foot.x(), foot.y(), heading);
  made.pose.T_world_object.translation().z() = foot.z();
  made.pose.box = {Eigen::Vector3d(-size.x() / 2, -size.y() / 2, 0),
                   Eigen::Vector3d(size.x() / 2, size.y() / 2, size.z())};
  made.score = 0.9;
  return made;
}

inline void
add(SemanticMap& map, const std::vector<Plane>& planes)
{
  for (const auto& plane : planes)
    map.planes.push_back({plane, {}, {}});
}

/** \brief Two rooms of 4 m x 3 m side by side, 2.5 m high, a wall of 0.1 m with a closed
 * door between them, from x = 0 to 8.1, y = 0 to 3. Planes: 1 floor, 2 ceiling, 3 to 6 the
 * outer walls (y = 0, y = 3, x = 0, x = 8.1), 7 and 8 the faces of the inner wall
 * (x = 4, x = 4.1), 9 the door, 10 a table top of no label. Objects: 1 table in the left
 * room, 2 chair beside it, 3 cup on the table, 4 bin in the right room. */
inline SemanticMap
twoRooms()
{
  SemanticMap map;
  add(map,
      {rectangle("floor", {0, 0, 0}, {8.1, 0, 0}, {0, 3, 0}),
       rectangle("ceiling", {0, 0, 2.5}, {8.1, 0, 0}, {0, 3, 0}),
       wall({0, 0}, {8.1, 0}),
       wall({0, 3}, {8.1, 3}),
       wall({0, 0}, {0, 3}),
       wall({8.1, 0}, {8.1, 3}),
       wall({4, 0}, {4, 3}),
       wall({4.1, 0}, {4.1, 3}),
       wall({4.05, 1}, {4.05, 1.9}, 0, 2, "door"),
       rectangle("none", {0.6, 1.1, 0.74}, {0.8, 0, 0}, {0, 0.8, 0})});
  map.objects = {object("table", {1, 1.5, 0}, {0.8, 0.8, 0.75}),
                 object("chair", {1.8, 1.5, 0}, {0.45, 0.45, 0.95}, 0.5),
                 object("cup", {1, 1.6, 0.75}, {0.08, 0.08, 0.1}),
                 object("waste bin", {7.8, 0.3, 0}, {0.3, 0.3, 0.4})};
  for (std::size_t i = 0; i < 3; ++i) {
    MapScan scan;
    scan.id = 2 * i; // every other one
    scan.file = "scan" + std::to_string(scan.id) + ".pcd";
    scan.T_world_scan = planarPose(1 + 3.2 * static_cast<double>(i), 2.5, 0.1);
    scan.T_world_scan.translation().z() = 1;
    map.scans.push_back(scan);
  }
  map.objects[0].scans = {0, 2};
  map.objects[3].scans = {4};
  map.planes[0].scans = {0, 2, 4};
  return map;
}

/** \return whether a map says so, e.g. ("object:3", "on", "plane:1") */
inline bool
says(const SemanticMap& map,
     const std::string& first,
     const std::string& predicate,
     const std::string& second)
{
  for (const auto& relation : map.relations)
    if (toString(relation.first) == first && relation.predicate == predicate &&
        toString(relation.second) == second)
      return true;
  return false;
}

/** \return how many relations have a predicate */
inline std::size_t
numRelations(const SemanticMap& map, const std::string& predicate)
{
  std::size_t count = 0;
  for (const auto& relation : map.relations)
    count += relation.predicate == predicate;
  return count;
}

} // namespace pcl6d::test
