// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scanner/moving_body.h>

#include <string>
#include <vector>

namespace pcl6d {

/** \brief A scene and the way of the robot through it. */
struct SimulationScene {
  std::string name;
  TriangleScene geometry;                 ///< [m], z up
  std::vector<Eigen::Vector3d> waypoints; ///< see RobotPath
  std::vector<MovingBody> moving;         ///< what moves while the robot drives
};

/** \return the names that builtInScene() knows */
std::vector<std::string>
builtInSceneNames();

/** \brief The scene called "corridor": a loop of 55 m through four furnished rooms and
 * four corridors, two of them ramps between floors at 0 m and 0.7 m.
 * \throws BadArgument unknown name; the message lists the known ones \ingroup scanner
 */
SimulationScene
builtInScene(const std::string& name);

} // namespace pcl6d
