// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/object_pose.h>
#include <pcl6d/common/plane.h>
#include <pcl6d/semantic_map/map_entity.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scan of a semantic map. */
struct MapScan {
  std::size_t id = 0; ///< index in the run
  std::string file;
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity(); ///< [m]
  /** of x y z roll pitch yaw [m, rad]; nullopt if unknown */
  std::optional<Eigen::Matrix<double, 6, 6>> covariance;
};

/** \brief Two scans that were matched. */
struct MapLink {
  std::size_t from = 0; ///< id of a scan
  std::size_t to = 0;   ///< id of a scan
  std::string kind;     ///< "sequence", "loop", ...; empty: unknown
  std::size_t pairs = 0;
  double rms = 0; ///< [m]
  /** inverse covariance, see PoseLink; nullopt if unknown */
  std::optional<Eigen::Matrix<double, 6, 6>> information;
};

/** \brief A labelled plane, measured and optionally refined (7.1.3). */
struct MapPlane {
  Plane measured;
  std::optional<Plane> refined;
  std::vector<std::size_t> scans; ///< ids of scans with points on the plane, ascending

  /** \return the refined plane, else the measured one */
  const Plane&
  best() const
  {
    return refined ? *refined : measured;
  }
};

/** \brief An object and the uncertainty of its pose. */
struct MapObject {
  ObjectPose pose;
  double score = 0;            ///< in [0, 1]
  double visible_fraction = 0; ///< of the surface that faced the scanner, in [0, 1]
  double rms = 0;              ///< [m] distance of its points to the model
  /** of x y z roll pitch yaw of T_world_object [m, rad]; nullopt if unknown */
  std::optional<Eigen::Matrix<double, 6, 6>> covariance;
  /** Rotational symmetry about the z axis, by 2 pi / symmetry; 1: no symmetry; 0: by
   * any angle, the heading is arbitrary. */
  int symmetry = 1;
  std::vector<std::size_t> scans; ///< ids of scans that saw the object, ascending
};

/** \brief The floors at one height. */
struct MapStorey {
  double floor = 0;              ///< [m] height along SemanticMap::up
  std::optional<double> ceiling; ///< [m] height of its largest ceiling
  double area = 0;               ///< [m^2] of its floor planes
};

/** \brief Floor area enclosed by walls (findRooms()). */
struct MapRoom {
  std::size_t storey = 1;       ///< id
  double area = 0;              ///< [m^2] inside the outline
  std::optional<double> height; ///< [m] from floor to ceiling
  std::vector<Eigen::Vector3d>
      outline; ///< [m] on the floor, counter-clockwise from above
};

/** \brief `first predicate second`, such as object:3 on plane:1; predicates: see
 * map_relations.h. */
struct MapRelation {
  Entity first;
  std::string predicate;
  Entity second;
};

/** \brief A semantic map (book 7.3): scans with their poses and links, planes with
 * labels, objects with classes and poses, rooms, and their spatial relations.
 * Everything is in the world frame of the run, in full coordinates.
 * \ingroup semantic_map */
struct SemanticMap {
  static constexpr int kSchemaVersion = 1;

  Eigen::Vector3d up = Eigen::Vector3d::UnitZ(); ///< unit
  Eigen::Vector3d world_offset =
      Eigen::Vector3d::Zero(); ///< [m] of the clouds of the run
  std::vector<MapScan> scans;  ///< ids ascend
  std::vector<MapLink> links;
  std::vector<MapPlane> planes;
  std::vector<MapObject> objects;
  std::vector<MapStorey> storeys; ///< from the lowest up
  std::vector<MapRoom> rooms;
  std::vector<MapRelation> relations;

  /** \return the index of an entity in its list; nullopt if the map has no such
   * entity */
  std::optional<std::size_t>
  placeOf(const Entity& entity) const;

  /** \return names of the labels of points: the names of PlaneLabel, then other labels
   * of planes, then the classes of objects, both in the order of the map. The index of
   * a name is the value of the field `label`; 0 is "none". */
  std::vector<std::string>
  labelNames() const;
};

/** \return whether a point lies inside the outline of a room, seen along up */
bool
isInPlan(const MapRoom& room, const Eigen::Vector3d& up, const Eigen::Vector3d& point);

/** \return the centre of the area of a room [m], on its floor */
Eigen::Vector3d
centreOf(const MapRoom& room, const Eigen::Vector3d& up);

/** \return the id of the room around a point; 0 without a room. Of several rooms with
 * the point in plan, the room with the highest floor not above the point. Floors that
 * differ by less than a storey are told apart by the plan only.
 * \param[in] tolerance [m] by which a floor may be above the point */
std::size_t
roomAt(const SemanticMap& map, const Eigen::Vector3d& point, double tolerance = 0.3);

/** \return the id of the storey with the highest floor not above a height [m] along up,
 * for entities in no room; 0 without storeys; the lowest storey below every floor
 * \param[in] tolerance [m] by which a floor may be above the height */
std::size_t
storeyAt(const SemanticMap& map, double height, double tolerance = 0.3);

} // namespace pcl6d
