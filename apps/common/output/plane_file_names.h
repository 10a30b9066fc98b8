// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl6d::app {

/** \return a regular expression for the files of PlaneFinder::write() and the picture
 * of the planes */
inline std::string
planeFilePattern()
{
  return "(planes\\.(json|pcd|png)|hulls\\.ply|labels\\.json|refined\\.pcd|"
         "refinement\\.json)";
}

} // namespace pcl6d::app
