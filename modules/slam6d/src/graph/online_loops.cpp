// SPDX-License-Identifier: BSD-3-Clause
#include "graph/online_loops.h"

#include <pcl6d/slam6d/auto_parameters.h>

#include <cmath>
#include <utility>
#include <vector>

namespace pcl6d::slam6d {

bool
OnlineLoops::close(const std::deque<IcpModel>& models,
                   std::size_t scan,
                   const Slam6DOptions& options,
                   Slam6DResult& result)
{
  while (stage_->size() <= scan)
    stage_->add(models[stage_->size()]);
  const std::vector<ScanResult> matched(result.scans.begin(),
                                        result.scans.begin() +
                                            static_cast<std::ptrdiff_t>(scan + 1));
  deriveLoopParameters(options, matched, result.parameters);
  if (static_cast<double>(scan) <
      static_cast<double>(last_closed_) + std::floor(result.parameters.loop_gap.value))
    return false; // scans still see the latest loop
  result.links = closed_.links;
  result.stages.clear();
  const bool has_moved = stage_->closeLoopsOfLast(result);
  closed_.links = std::exchange(result.links, {});
  for (StageResult& stage : result.stages)
    closed_.stages.push_back(std::move(stage));
  result.stages.clear();
  if (has_moved)
    last_closed_ = scan;
  return has_moved;
}

} // namespace pcl6d::slam6d
