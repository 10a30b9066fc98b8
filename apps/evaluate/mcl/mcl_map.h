// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/mcl/mcl_settings.h"

#include <pcl6d/localisation/segment_map.h>

#include <string>

namespace pcl6d::app {

/** \brief Map of walls for the localisation, from any source. */
struct MclMap {
  Segments walls; ///< [m]
  Eigen::Matrix3d R_map_world =
      Eigen::Matrix3d::Identity(); ///< turns a tilted map upright
  std::string source;              ///< source of the walls, for display
};

/** \brief Reads a plan, planes, a cloud or a mesh, depending on the extension.
 * \throws IoFailed naming the file: broken, or without a wall */
MclMap
readMclMap(const MclSettings& settings);

} // namespace pcl6d::app
