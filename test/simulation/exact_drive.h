// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/simulation/simulation_scene.h>
#include <pcl6d/simulation/simulator.h>

namespace pcl6d::test {

inline SimulationOptions
exactDrive(const SimulationScene& scene)
{
  SimulationOptions options;
  options.num_scans = scene.num_scans;
  options.range.noise = 0;
  options.range.max_range = scene.max_range;
  return options;
}

} // namespace pcl6d::test
