// SPDX-License-Identifier: BSD-3-Clause
#include "built_in/built_in_scenes.h"
#include "built_in/worlds.h"

#include <pcl6d/common/error.h>

#include <array>
#include <string_view>

namespace {
using namespace pcl6d;
using namespace pcl6d::simulation;

struct World {
  std::string_view name;
  SimulationScene (*make)(std::uint64_t seed);
};
constexpr std::array<World, 10> kWorlds = {{{"campus", campusScene},
                                            {"crowd", crowdScene},
                                            {"glass", glassScene},
                                            {"mine", mineScene},
                                            {"multilevel", multilevelScene},
                                            {"parking", parkingScene},
                                            {"rooms", roomsScene},
                                            {"shelves", shelvesScene},
                                            {"tunnel", tunnelScene},
                                            {"twins", twinsScene}}};
} // namespace

void
pcl6d_simulation_worlds(const char* name, std::uint64_t seed, SimulationScene& scene)
{
  for (const World& world : kWorlds)
    if (world.name == name) {
      scene = world.make(seed);
      return;
    }
  throw BadArgument("no world '" + std::string(name) + "' in pcl6d_simulation_worlds");
}
