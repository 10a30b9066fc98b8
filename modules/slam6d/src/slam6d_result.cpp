// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/pose.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <algorithm>

namespace pcl6d {

std::size_t
Slam6DResult::count(ScanState state) const
{
  return countScans(scans, state);
}

bool
Slam6DResult::trusted() const
{
  // If points and rays confirm the whole map, a match stopped at its iteration limit counts as
  // converged.
  const bool is_confirmed = verification && verification->trust == MapTrust::kGood;
  const auto matched = static_cast<std::size_t>(
      std::count_if(scans.begin(), scans.end(), [&](const ScanResult& scan) {
        return scan.state == ScanState::kFixed || scan.state == ScanState::kMatched ||
               (is_confirmed && scan.state == ScanState::kUnconverged &&
                scan.status != Status::kRankDeficient); // a motion of the given poses
      }));
  if (control && (!control->adjusted || !control->doubt.empty()))
    return false;
  return floating.empty() && (!verification || verification->trusted()) &&
         matched == scans.size();
}

RunResult
runResultOf(const Slam6DResult& result,
            const std::vector<std::string>& files,
            const std::vector<int>& indices)
{
  RunResult run;
  run.scans = result.scans;
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    run.scans[i].file = files.at(i);
    run.scans[i].index = indices.at(i);
    if (result.stages.empty()) // no stage has changed the poses
      run.scans[i].matched_pose = run.scans[i].T_world_scan;
  }
  if (!run.scans.empty())
    run.world_offset = worldOffset(run.scans.front().T_world_scan);
  run.graph_stages = result.stages;
  for (const ScanLink& link : result.links) {
    RunLink& kept = run.links.emplace_back(link);
    kept.from = static_cast<std::size_t>(indices.at(link.from));
    kept.to = static_cast<std::size_t>(indices.at(link.to));
    ++(link.verdict == LinkVerdict::kUsed ? run.links_used : run.links_refused);
  }
  for (const std::size_t i : result.floating)
    run.floating.push_back(files.at(i));
  run.verification = result.verification;
  run.control = result.control;
  run.trusted = result.trusted();
  return run;
}

} // namespace pcl6d
