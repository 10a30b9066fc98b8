// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/simulation/simulator.h>

#include <cstdint>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Number of bodies that move about the robot. */
struct TrafficOptions {
  int people = 0;         ///< in [0, 200]
  int cars = 0;           ///< in [0, 200]
  std::uint64_t seed = 1; ///< equal seeds give equal ways
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Adds people and cars to a scene. They move about the robot during the drive
 * (BodyWays), on free floor (groundOfScene()).
 * \param[in] drive in the scene without traffic
 * \throws BadArgument see TrafficOptions::validate() \throws ComputeFailed not enough
 * room for the bodies \ingroup simulation */
void
addTraffic(SimulationScene& scene,
           const Simulator& drive,
           const TrafficOptions& options);

} // namespace pcl6d
