// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simulate/drive_options.h"
#include "simulate/scanner_options.h"
#include "simulate/scene_options.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pcl6d::app {

constexpr const char* kSimulate = "pcl_slam6d_simulate"; ///< the program's name

/** \brief The command line of pcl_slam6d_simulate. */
struct SimulateSettings {
  SceneWords scene;
  ScannerWords scanner;
  DriveWords drive;
  std::string out;
  bool has_scans = false; ///< given by the user
  std::int64_t seed = 1;  ///< signed, as boost takes -1 for a large unsigned number
  int threads = 0;
  bool force = false;
  bool quiet = false;
  SimulationOptions simulation;
};

/** \brief Fills the settings from the command line and the config file.
 * \return false when there is nothing more to do (--help)
 * \throws UsageError, boost::program_options::error an option breaks its rule */
bool
parseSettings(const std::vector<std::string>& arguments, SimulateSettings& settings);

/** \brief Makes or reads the scene, and fills in what the user left to it.
 * \throws UsageError the scene is not known, or options do not fit it
 * \throws IoFailed a file is wrong */
SimulationScene
sceneOf(SimulateSettings& settings);

} // namespace pcl6d::app
