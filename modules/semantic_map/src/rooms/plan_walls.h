// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scene_interpretation/scene_plane.h>
#include <pcl6d/semantic_map/find_rooms.h>

#include <Eigen/Core>

#include <vector>

/** \file Walls and doors as lines of a plan. Internal to the module semantic_map. */
namespace pcl6d::semantic_map {

/** \brief A line of a plan [m]. */
struct PlanLine {
  Eigen::Vector2d from;
  Eigen::Vector2d to;

  Eigen::Vector2d
  at(double share) const
  {
    return from + share * (to - from);
  }
  double
  length() const
  {
    return (to - from).norm();
  }
};

/** \return the extent of an upright plane in plan */
PlanLine
planLine(const ScenePlane& plane);

/** \brief Extends lines by up to max_gap at each end, to close corners that nearly
 * meet. */
void
joinCorners(std::vector<PlanLine>& lines, double max_gap);

/** \return a line for each gap of a wall: between two pieces of at least 0.3 m, that
 * follow each other within 0.1 m of one line, up to max_door apart */
std::vector<PlanLine>
doorways(const std::vector<PlanLine>& lines, double max_door);

/** \return open doors in walls with a continuous line, for example below a lintel,
 * detected by floor points inside the wall
 * \param[in] floor points of the floor
 * \param[in] max_door [m] wider openings are not doors */
std::vector<PlanLine>
openDoors(const std::vector<PlanLine>& lines,
          const std::vector<Eigen::Vector2d>& floor,
          double max_door);

} // namespace pcl6d::semantic_map
