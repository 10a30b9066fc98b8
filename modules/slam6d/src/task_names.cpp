// SPDX-License-Identifier: BSD-3-Clause
#include "task_names.h"

#include <pcl6d/common/fingerprint.h>

namespace pcl6d::slam6d {

std::uint64_t
inputsOf(std::uint64_t before,
         std::size_t place,
         const Points& points,
         const ScanResult& scan,
         const DriveContext& drive)
{
  Fingerprint sum;
  if (place > 0)
    sum.add(before);
  sum.add(points);
  sum.add(scan.initial_pose);
  if (drive.is_step_measured)
    sum.add(std::uint32_t{1});
  if (!drive.frame.isZero(0))
    for (Eigen::Index i = 0; i < drive.frame.size(); ++i)
      sum.add(drive.frame.data()[i]);
  for (const PosedPoints& sweep : drive.submap) {
    sum.add(sweep.points);
    sum.add(sweep.pose);
  }
  if (scan.state != ScanState::kPending) { // by an earlier run
    sum.add(scan.T_world_scan);
    sum.add(static_cast<std::uint32_t>(scan.state));
  }
  return sum.value();
}

std::uint64_t
taskOf(std::uint64_t inputs,
       const Slam6DResult& result,
       std::size_t improved,
       const std::vector<ScanPair>& links)
{
  Fingerprint sum;
  sum.add(inputs);
  Slam6DParameters parameters = result.parameters;
  for (const Parameter* parameter : parametersOf(parameters))
    sum.add(parameter->value);
  for (std::size_t i = 0; i < improved; ++i)
    sum.add(result.scans[i].T_world_scan);
  for (const auto& [from, to] : links) {
    sum.add(static_cast<std::uint64_t>(from));
    sum.add(static_cast<std::uint64_t>(to));
  }
  return sum.value();
}

} // namespace pcl6d::slam6d
