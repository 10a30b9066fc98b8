// SPDX-License-Identifier: BSD-3-Clause
#include "corridor_scene.h"

#include <pcl6d/common/error.h>
#include <pcl6d/scanner/simulation_scene.h>

#include <array>

namespace pcl6d {
namespace {
struct Entry {
  const char* name;
  SimulationScene (*make)();
};
constexpr std::array<Entry, 1> kScenes = {{{"corridor", corridorScene}}};
} // namespace

std::vector<std::string>
builtInSceneNames()
{
  std::vector<std::string> names;
  for (const auto& scene : kScenes)
    names.emplace_back(scene.name);
  return names;
}

SimulationScene
builtInScene(const std::string& name)
{
  std::string known;
  for (const auto& scene : kScenes) {
    if (name == scene.name)
      return scene.make();
    known += std::string(known.empty() ? "" : ", ") + scene.name;
  }
  throw BadArgument("no scene '" + name + "'; known: " + known);
}

} // namespace pcl6d
