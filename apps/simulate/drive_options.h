// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/command_line.h"

#include <pcl6d/scanner/simulator.h>

#include <string>

namespace pcl6d::app {

/** \brief How the robot drives, as given on the command line. */
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

} // namespace pcl6d::app
