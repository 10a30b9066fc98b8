// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl6d::app {

/** \return the names of the files that PlaneFinder::write() leaves, and that of their
 * picture, as a regular expression */
inline std::string
planeFilePattern()
{
  return "(planes\\.(json|pcd|png)|hulls\\.ply|labels\\.json|refined\\.pcd|"
         "refinement\\.json)";
}

} // namespace pcl6d::app
