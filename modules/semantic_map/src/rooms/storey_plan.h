// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "rooms/plan_grid.h"

#include <pcl6d/scene_interpretation/scene_plane.h>
#include <pcl6d/semantic_map/find_rooms.h>

#include <vector>

/** \file The rooms of one storey. Internal to the module semantic_map. */
namespace pcl6d::semantic_map {

/** \brief A plane of a storey, levelled; its corners are in the frame of the plan. */
struct PlanPlane {
  std::size_t id; ///< of the map
  ScenePlane shape;
};

/** \brief The planes of a storey, in the frame of its plan. */
struct StoreyPlanes {
  double floor = 0; ///< [m]
  std::vector<PlanPlane> floors;
  std::vector<PlanPlane> ceilings;
  std::vector<PlanPlane> walls;
  std::vector<PlanPlane> doors;
  std::vector<Eigen::Vector2d> seen; ///< floor points; empty: not known
};

/** \brief A room in the frame of the plan. */
struct PlanRoom {
  std::vector<Eigen::Vector2d> outline;
  double area = 0;
  std::optional<double> height;
  std::vector<std::size_t> planes; ///< ids of the planes that bound the room, ascending
  std::vector<std::size_t> neighbours; ///< indices of rooms beyond a door, ascending
};

/** \return the rooms, the largest first */
std::vector<PlanRoom>
roomsOf(const StoreyPlanes& storey, const RoomOptions& options);

} // namespace pcl6d::semantic_map
