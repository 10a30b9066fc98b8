// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/command_line.h"

#include <pcl6d/simulation/simulator.h>

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace pcl6d::app {

/** \brief How the robot drives and what it knows of that, as given on the command line.
 */
struct DriveWords {
  std::string motion = "stop";
  std::string odometry = "wheel";
  AutoDouble speed; ///< [m/s]
};

void
describeDrive(CommandLine& line, DriveWords& words);

/** \throws UsageError naming the option that breaks its rule */
void
applyDrive(const DriveWords& words, SimulationOptions& options);

/** \brief Simulates the drive, without the scans. \throws UsageError the speed leaves no
 * time for a scan, or another option breaks its rule */
Simulator
startDrive(const SimulationScene& scene, const SimulationOptions& options);

/** \return the entries of scene.json that are not as by default */
nlohmann::ordered_json
describedDrive(const DriveWords& words, const Simulator& simulator);

} // namespace pcl6d::app
