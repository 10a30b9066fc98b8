// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/mcl_settings.h"

#include <pcl6d/localisation/segment_map.h>

#include <string>

namespace pcl6d::app {

/** \brief The walls of a place, however they are known. */
struct MclMap {
  Segments walls; ///< [m]
  Eigen::Matrix3d R_map_world =
      Eigen::Matrix3d::Identity(); ///< turns a tilted one upright
  std::string source;              ///< what they were made from, for people
};

/** \brief Reads a plan, planes, a cloud or a mesh, as its extension says.
 * \throws IoFailed naming the file: it is broken, or has no wall */
MclMap
readMclMap(const MclSettings& settings);

} // namespace pcl6d::app
