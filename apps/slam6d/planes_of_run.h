// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/filters/map_builder.h>

#include <filesystem>
#include <string>
#include <vector>

/** \file The planes of a run, in a library of their own: what finds them is as much to
 * compile as a quarter of the program, and only --planes needs it. */
namespace pcl6d::app {

/** \brief What a run knows when its planes are looked for. */
struct PlanesOfRun {
  const MapBuilder& map; ///< whose scan numbers are places in poses
  const std::vector<Eigen::Isometry3d>& poses;
  Eigen::Vector3d world_offset;
  unsigned int num_threads;
  std::filesystem::path folder;
  std::string generator; ///< as it stands in planes.json
};

/** \brief Finds planes and writes them. \throws as PlaneFinder */
using WritePlanesOfRun = void(const PlanesOfRun& run);

/** \return the function that does it; its library is opened with the first call, and is
 * there from then on
 * \throws IoFailed the library is not there; the message says what builds it */
WritePlanesOfRun&
planesOfRun();

} // namespace pcl6d::app

extern "C" [[gnu::visibility("default")]] void
pcl6d_planes_of_run(const pcl6d::app::PlanesOfRun& run);
