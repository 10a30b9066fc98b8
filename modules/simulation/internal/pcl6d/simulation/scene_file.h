// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/io/mesh_io.h>
#include <pcl6d/simulation/simulation_scene.h>

#include <filesystem>

/** \file
 * User-defined scenes. A scene description is a JSON file:
 * \code
 * {
 *   "name": "yard",                        // all but bodies and waypoints may be missing
 *   "scans": 60, "max_range": 40,          // what suits the scene; [m]
 *   "materials": {"brick": {"reflectance": 0.4, "label": "wall"},
 *                 "glass": {"reflectance": 0.15, "transmittance": 0.8}},
 *   "bodies": [
 *     {"type": "terrain", "low": [-50, -50], "high": [50, 50], "amplitude": 1},
 *     {"type": "box", "material": "brick", "centre": [5, 0, 1], "size": [2, 3, 2]},
 *     {"type": "wall", "material": "brick", "from": [0, 4], "to": [9, 4], "top": 2.5,
 *      "openings": [{"begin": 1, "end": 2, "high": 2, "leaf": "oak"}]}
 *   ],
 *   "objects": [{"class": "chair", "file": "chair.ply", "position": [1, 2, 0]}],
 *   "moving": [{"class": "person", "bodies": [...], "way": [[0, 0], [9, 0]]}],
 *   "waypoints": [[0, 0, 0], [8, 0, 0], [8, 8, 0]]
 * }
 * \endcode
 * Types of bodies and their keys are those of the structs Box, Wall, Ramp, Stairs,
 * Revolved, TerrainOptions; `cylinder` has foot, radius, height; `model` has file,
 * scale, up ("y" or "z"), position, roll, pitch, yaw. Lengths are in metres, angles in
 * radians. A position of two numbers lies on the terrain. An unknown key is an
 * error. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Reads a scene description. File names are relative to its folder.
 * \throws IoFailed naming the file, the position as a JSON pointer such as
 * /bodies/3/size, and the error \ingroup simulation */
SimulationScene
readScene(const std::filesystem::path& path);

/** \brief Makes a scene of one mesh and the way of the robot through it. Its planes are
 * unknown. \throws IoFailed see readMesh() */
SimulationScene
meshScene(const std::filesystem::path& path,
          const std::vector<Eigen::Vector3d>& waypoints,
          const MeshOptions& options = {});

} // namespace pcl6d
