// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "simulate/scene_options.h"

#include <pcl6d/simulation/simulator.h>
#include <pcl6d/simulation/traffic.h>

#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

constexpr const char* kSimulate = "pcl_slam6d_simulate"; ///< the program's name

/** \brief The command line of pcl_slam6d_simulate. */
struct SimulateSettings {
  SceneSettings scene;
  std::optional<int> scans; ///< default: chosen for the scene
  std::string scanner = "rotating";
  std::optional<double> resolution; ///< [deg] default: the scanner's
  std::optional<double> noise;      ///< [m] default: the scanner's
  std::optional<double> max_range;  ///< [m] default: chosen for scene or scanner
  TrafficOptions traffic;           ///< its seed is the simulation's seed
  bool exact = false;               ///< rays and ranges without errors
  std::string odometry = "wheel";
  std::string out;
  bool force = false;
  bool quiet = false;
  SimulationOptions simulation;
};

/** \brief Fills the settings from the command line and the config file.
 * \return false after --help
 * \throws UsageError, boost::program_options::error an option is invalid */
bool
parseSettings(const std::vector<std::string>& arguments, SimulateSettings& settings);

/** \brief Makes or reads the scene, and fills in unset settings.
 * \throws UsageError the scene is unknown, or options do not fit it
 * \throws IoFailed a file is wrong */
SimulationScene
sceneOf(SimulateSettings& settings);

} // namespace pcl6d::app
