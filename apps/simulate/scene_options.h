// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/options/option_table.h"

#include <pcl6d/io/mesh_io.h>
#include <pcl6d/simulation/simulator.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The scene, from the command line. */
struct SceneSettings {
  std::string name;       ///< of a built-in scene, or a file .json, .ply, .obj, .stl
  std::string path;       ///< file with waypoints; for meshes
  double scale = 1;       ///< [m] per unit of a mesh
  UpAxis up = UpAxis::kZ; ///< of a mesh
  std::optional<bool> labels;       ///< default: labels except for corridor
  std::vector<std::string> without; ///< classes of objects to leave out
};

/** \return the known scenes, a line each, for --help */
std::string
sceneList();

void
addScene(OptionTable& table, SceneSettings& scene);

/** \brief Makes or reads the scene. \param[in] seed of random parts
 * \throws UsageError the scene is unknown, or options do not fit it
 * \throws IoFailed a file is wrong */
SimulationScene
loadScene(const SceneSettings& words, std::uint64_t seed);

/** \return whether points get labels and truth files are written */
bool
wantsLabels(const SceneSettings& words);

/** \brief Adds the source of the scene to scene.json. */
void
describeScene(const SceneSettings& words,
              const SimulationScene& scene,
              nlohmann::ordered_json& json);

} // namespace pcl6d::app
