// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl6d::app {

/** \return the names of the files that make a run of pcl_slam6d, and that other programs read,
 * as a regular expression: not of what these put beside them */
inline std::string
runFilePattern()
{
  return "(trajectory\\.(kitti|tum)|frames/scan[0-9]+\\.frames|scans/scan[0-9]+\\.pcd|"
         "(map|moving)\\.pcd|graph\\.g2o|(links|verification)\\.csv|summary\\.json)";
}

} // namespace pcl6d::app
