// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/simulation/simulation_scene.h>

#include <cstdint>

/** \brief Makes a built-in scene other than the corridor, planes not yet numbered. Where
 * libraries are shared, this and all those scenes are in the library
 * pcl6d_simulation_worlds, which builtInScene() opens when one is asked for.
 * \param[in] name one that there is \param[out] scene */
extern "C" [[gnu::visibility("default")]] void
pcl6d_simulation_worlds(const char* name,
                        std::uint64_t seed,
                        pcl6d::SimulationScene& scene);
