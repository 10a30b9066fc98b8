// SPDX-License-Identifier: BSD-3-Clause
#include "evaluate/mcl_errors.h"

#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/common/error.h>
#include <pcl6d/io/trajectory_io.h>

namespace pcl6d::app {

MclErrors
mclErrors(const MclEvaluation& e, const Trajectory& reference, bool only_trusted)
{
  std::vector<double> position_2d, yaw, position, orientation;
  for (std::size_t i = 0; i < e.scans.size(); ++i) {
    if (only_trusted && !e.estimates[i].trusted())
      continue;
    const PoseError error =
        poseError(e.scans[i].T_map_scan, e.T_map_world * reference.poses[i]);
    position_2d.push_back(error.position_2d);
    yaw.push_back(error.yaw);
    position.push_back(error.position);
    orientation.push_back(error.orientation);
  }
  return {yaw.size(),
          errorStatistics(position_2d),
          errorStatistics(yaw),
          errorStatistics(position),
          errorStatistics(orientation)};
}

Trajectory
readMclReference(const std::string& file, const ScanFolder& folder)
{
  const Trajectory all = readTrajectory(file);
  if (all.poses.size() == folder.size())
    return all;
  if (all.poses.size() != folder.odometry().poses.size())
    throw IoFailed(file + ": holds " + std::to_string(all.poses.size()) +
                   " poses, but must hold one for each of the " +
                   std::to_string(folder.size()) + " scans");
  Trajectory selected;
  for (std::size_t i = 0; i < folder.size(); ++i)
    selected.poses.push_back(all.poses[static_cast<std::size_t>(folder.index(i))]);
  return selected;
}

} // namespace pcl6d::app
