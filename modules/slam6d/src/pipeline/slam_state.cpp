// SPDX-License-Identifier: BSD-3-Clause
#include "../registered.h"
#include "slam_state.h"

#include <pcl6d/filters/planar_scan.h>

namespace pcl6d::slam6d {

SlamState::SlamState(const Slam6DOptions& given)
: options(given)
, scans(options)
, verification(given.num_threads)
, motion(options)
, moving(given.num_threads)
, recovery(options, verification.scans())
{
  options.validate();
}

GraphStage
SlamState::makeGraphStage(WorkSharing* sharing,
                          const Slam6DParameters& parameters) const
{
  return GraphStage(options,
                    parameters,
                    map->matcher().icpOptions(scans.reduced().front().points().size()),
                    map->matcher().modelOptions(true),
                    sharing);
}

void
SlamState::keepInPlane()
{
  if (!(result.parameters.planar_rows.value > 0))
    return;
  const ScanResult first = result.scans.front();
  for (std::size_t i = 1; i < result.scans.size(); ++i) {
    ScanResult& scan = result.scans[i];
    if (isRegistered(scan) &&
        (isWithoutSequence() || isInPlane(first.initial_pose, scan.initial_pose)))
      scan.T_world_scan = poseInPlane(first.T_world_scan, scan.T_world_scan);
    if (i < result.graph.poses.size())
      result.graph.poses[i] = scan.T_world_scan;
  }
}

} // namespace pcl6d::slam6d
