// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/simulation/simulation_scene.h>

/** \file The built-in scenes, planes not yet numbered. Each source file begins with a
 * plan of its scene. With shared libraries, every scene except corridor is in a
 * separate library: worlds.h. */
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
