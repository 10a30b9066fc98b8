// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/filters/map_builder.h>

#include <filesystem>
#include <string>
#include <vector>

/** \file The planes of a run, in a separate library: the plane finder takes as long to compile as a
 * quarter of the program, and is required only for --planes. */
namespace pcl6d::app {

/** \brief Data of a run for the search for planes. */
struct PlanesOfRun {
  const MapBuilder& map; ///< with scan numbers that are indices into poses
  const std::vector<Eigen::Isometry3d>& poses;
  Eigen::Vector3d world_offset;
  unsigned int num_threads;
  std::filesystem::path folder;
  std::string generator; ///< for planes.json
};

/** \brief Finds planes and writes them. \throws as PlaneFinder */
using WritePlanesOfRun = void(const PlanesOfRun& run);

/** \return the function of the library, which is loaded by the first call and stays loaded
 * \throws IoFailed the library is missing; the message says how to build it */
WritePlanesOfRun&
planesOfRun();

} // namespace pcl6d::app

extern "C" [[gnu::visibility("default")]] void
pcl6d_planes_of_run(const pcl6d::app::PlanesOfRun& run);
