// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pcl6d::app {

/** \return a regular expression for the files of a run of pcl_slam6d read by other
 * programs, without the output of these programs */
inline std::string
runFilePattern()
{
  return "(trajectory\\.(kitti|tum)|frames/scan[0-9]+\\.frames|scans/scan[0-9]+\\.pcd|"
         "(map|moving)\\.pcd|graph\\.g2o|(links|verification|control)\\.csv|summary\\."
         "json)";
}

} // namespace pcl6d::app
