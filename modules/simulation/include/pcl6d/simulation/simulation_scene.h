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
  /** The object with id i at place i - 1; poses in the scene's frame */
  std::vector<ObjectPose> objects;
  std::vector<MovingBody> moving; ///< what moves while the robot drives
  std::string description;        ///< the JSON text that it was read from; may be empty
  int num_scans = 40;             ///< that cover the way well
  double max_range = 30;          ///< [m] that suits its size

  /** \brief Adds an object of a class with a shape of its own.
   * \return its id, from 1 */
  std::uint32_t
  addObject(const std::string& object_class,
            const TriangleScene& shape,
            const Eigen::Isometry3d& T_scene_object);

  /** \brief Adds a body that moves, as an object of the class that its name is.
   * \return its id, from 1; its pose among the objects is that at time 0
   * \throws BadArgument see MovingBody::validate() */
  std::uint32_t
  addMoving(MovingBody body);
};

/** \return the objects in another frame
 * \param[in] T_scene_world that frame in the coordinates of the scene */
std::vector<ObjectPose>
sceneObjects(const SimulationScene& scene, const Eigen::Isometry3d& T_scene_world);

/** \return the scene without its objects of some classes; the others, and the planes, are
 * numbered anew. Classes that it does not have are no error. */
SimulationScene
withoutObjects(const SimulationScene& scene, const std::vector<std::string>& classes);

/** \return the names that builtInScene() knows */
std::vector<std::string>
builtInSceneNames();

/** \return what there is in a built-in scene, in one line
 * \throws BadArgument unknown name */
std::string
builtInSceneDescription(const std::string& name);

/** \brief A scene that comes with the suite: "corridor", a loop of 55 m through four
 * furnished rooms and four corridors, two of them ramps between floors at 0 m and 0.7 m;
 * the others: builtInSceneDescription().
 * \param[in] seed of what is random in a scene, such as rooms and furniture; corridor,
 * multilevel, twins, tunnel, shelves and glass are always the same
 * \throws BadArgument unknown name; the message lists the known ones
 * \throws IoFailed the library that has all but the corridor is not there
 * \ingroup simulation */
SimulationScene
builtInScene(const std::string& name, std::uint64_t seed = 1);

} // namespace pcl6d
