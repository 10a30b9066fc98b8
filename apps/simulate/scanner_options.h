// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/command_line.h"

#include <pcl6d/simulation/simulator.h>

#include <string>

namespace pcl6d::app {

/** \brief Which scanner, as given on the command line. */
struct ScannerWords {
  std::string name = "rotating";
  AutoDouble resolution; ///< [deg]
  AutoDouble noise;      ///< [m]
  AutoDouble max_range;  ///< [m]
  bool exact = false;
};

/** \return the known scanners, a line each, for --help */
std::string
scannerList();

void
describeScanner(CommandLine& line, ScannerWords& words);

/** \brief Sets the scanner and how it measures.
 * \param[in] scene_range [m] that suits the scene
 * \throws UsageError naming the option that breaks its rule */
void
applyScanner(const ScannerWords& words, double scene_range, SimulationOptions& options);

} // namespace pcl6d::app
