// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/simulation/simulation_scene.h>

/** \file The scenes that come with the suite, planes not yet numbered. Each begins with a
 * plan of it. All but the corridor are in a library of their own, where libraries are
 * shared: worlds.h. */
namespace pcl6d::simulation {

SimulationScene
campusScene(std::uint64_t seed);

SimulationScene
corridorScene(std::uint64_t seed);

SimulationScene
crowdScene(std::uint64_t seed);

SimulationScene
glassScene(std::uint64_t seed);

SimulationScene
mineScene(std::uint64_t seed);

SimulationScene
multilevelScene(std::uint64_t seed);

SimulationScene
parkingScene(std::uint64_t seed);

SimulationScene
roomsScene(std::uint64_t seed);

SimulationScene
shelvesScene(std::uint64_t seed);

SimulationScene
tunnelScene(std::uint64_t seed);

SimulationScene
twinsScene(std::uint64_t seed);

} // namespace pcl6d::simulation
