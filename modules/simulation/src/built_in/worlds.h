// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/simulation/simulation_scene.h>

#include <cstdint>

/** \brief Makes a built-in scene other than corridor, planes not yet numbered. With
 * shared libraries, these scenes are in the library pcl6d_simulation_worlds, opened by
 * builtInScene() on demand.
 * \param[in] name of an existing scene \param[out] scene */
extern "C" [[gnu::visibility("default")]] void
pcl6d_simulation_worlds(const char* name,
                        std::uint64_t seed,
                        pcl6d::SimulationScene& scene);
