// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/object_pose.h>
#include <pcl6d/simulation/moving_body.h>
#include <pcl6d/simulation/triangle_scene.h>

#include <cstdint>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A scene and the way of the robot through it. */
struct SimulationScene {
  std::string name;
  TriangleScene geometry;                 ///< [m], z up; planes are numbered
  std::vector<Eigen::Vector3d> waypoints; ///< see RobotPath
  /** The object with id i has index i - 1; poses in the scene's frame */
  std::vector<ObjectPose> objects;
  std::vector<MovingBody> moving; ///< bodies that move during the drive
  std::string description;        ///< source text in JSON; may be empty
  int num_scans = 40;             ///< suitable number for the way
  double max_range = 30;          ///< [m] suitable for the scene's size

  /** \brief Adds an object with its own shape.
   * \return its id, from 1 */
  std::uint32_t
  addObject(const std::string& object_class,
            const TriangleScene& shape,
            const Eigen::Isometry3d& T_scene_object);

  /** \brief Adds a moving body, as an object with its name as class.
   * \return its id, from 1; the pose in `objects` is the pose at time 0
   * \throws BadArgument see MovingBody::validate() */
  std::uint32_t
  addMoving(MovingBody body);
};

/** \return the objects in another frame
 * \param[in] T_scene_world the other frame in the coordinates of the scene */
std::vector<ObjectPose>
sceneObjects(const SimulationScene& scene, const Eigen::Isometry3d& T_scene_world);

/** \return the scene without objects of some classes; remaining objects and planes are
 * renumbered. Unknown classes are ignored. */
SimulationScene
withoutObjects(const SimulationScene& scene, const std::vector<std::string>& classes);

/** \return the names for builtInScene() */
std::vector<std::string>
builtInSceneNames();

/** \return a description of a built-in scene, in one line
 * \throws BadArgument unknown name */
std::string
builtInSceneDescription(const std::string& name);

/** \brief Makes a built-in scene: "corridor", a loop of 55 m through four furnished
 * rooms and four corridors, two of them ramps between floors at 0 m and 0.7 m; other
 * scenes: builtInSceneDescription().
 * \param[in] seed of random parts, such as rooms and furniture; corridor, multilevel,
 * twins, tunnel, shelves and glass have no random parts
 * \throws BadArgument unknown name; the message lists the known names
 * \throws IoFailed the library of the scenes other than corridor is missing
 * \ingroup simulation */
SimulationScene
builtInScene(const std::string& name, std::uint64_t seed = 1);

} // namespace pcl6d
