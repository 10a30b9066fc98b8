// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/simulator.h>

#include <cstdint>

namespace PCL6D_EXPORTS pcl6d {

/** \brief How many bodies are to move about the robot. */
struct TrafficOptions {
  int people = 0;         ///< in [0, 200]
  int cars = 0;           ///< in [0, 200]
  std::uint64_t seed = 1; ///< same seed, same ways
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Adds people and cars to a scene, which move about the robot as long as it drives
 * (BodyWays), on floor that is free (groundOfScene()).
 * \param[in] drive of the same scene without them
 * \throws BadArgument see TrafficOptions::validate() \throws ComputeFailed there is no room
 * for so many \ingroup simulation */
void
addTraffic(SimulationScene& scene,
           const Simulator& drive,
           const TrafficOptions& options);

} // namespace pcl6d
