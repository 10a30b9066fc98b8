// SPDX-License-Identifier: BSD-3-Clause
#include "any_order/joined_runs.h"
#include "registered.h"

#include <pcl6d/slam6d/groups_apart.h>

#include <algorithm>

namespace pcl6d::slam6d {

namespace {
/** \return the number of the run whose world is kept; none without known poses */
std::optional<std::size_t>
firstGroupOf(const KnownPlaces& known)
{
  std::optional<std::size_t> first;
  for (const auto& place : known)
    if (place && (!first || place->group < *first))
      first = place->group;
  return first;
}
} // namespace

bool
isOfFurtherRun(std::size_t scan, const std::vector<std::size_t>& runs)
{
  return scan < runs.size() &&
         runs[scan] != *std::min_element(runs.begin(), runs.end());
}

KnownPlaces
knownPlaces(const std::vector<std::size_t>& runs, const std::vector<ScanResult>& scans)
{
  KnownPlaces known(scans.size());
  const std::size_t first =
      runs.empty() ? 0 : *std::min_element(runs.begin(), runs.end());
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (isRegistered(scans[i])) // without an entry in runs: first run
      known[i] = {i < runs.size() ? runs[i] : first, scans[i].T_world_scan};
  return known;
}

void
requireJoined(const KnownPlaces& known, const JoinedScans& joined)
{
  for (std::size_t i = 0; i < known.size(); ++i)
    if (known[i] && joined.scans[i].group != 0)
      throw GroupsApart(known[i]->group, toWords(joined.scans[i].rejection));
}

void
sortKnown(const KnownPlaces& known,
          const std::vector<ScanResult>& scans,
          JoinedScans& joined)
{
  const auto first = firstGroupOf(known);
  const auto holds_world = [&](std::size_t i) {
    return known[i]->group == *first && scans[i].state == ScanState::kFixed;
  };
  for (auto& group : joined.groups) {
    const auto end =
        std::stable_partition(group.begin(), group.end(), [&](std::size_t i) {
          return known[i].has_value();
        });
    std::sort(group.begin(), end, [&](std::size_t a, std::size_t b) {
      const bool a_holds = holds_world(a), b_holds = holds_world(b);
      return a_holds != b_holds ? a_holds : a < b;
    });
  }
}

void
moveRuns(const std::vector<std::size_t>& runs,
         const JoinedScans& joined,
         Slam6DResult& result)
{
  for (std::size_t begin = 0, end = 0; begin < runs.size(); begin = end) {
    while (end < runs.size() && runs[end] == runs[begin])
      ++end;
    std::optional<Eigen::Isometry3d> T_world_run; // from the run's first registered
                                                  // scan
    for (std::size_t i = begin; i < end && !T_world_run; ++i)
      if (isRegistered(result.scans[i]))
        T_world_run =
            joined.scans[i].T_group_scan * result.scans[i].T_world_scan.inverse();
    for (std::size_t i = begin; i < end && isOfFurtherRun(i, runs); ++i) {
      ScanResult& scan = result.scans[i];
      if (T_world_run)
        scan.initial_pose = *T_world_run * scan.initial_pose;
      if (!isRegistered(scan))
        continue;
      scan.matched_pose = scan.T_world_scan = joined.scans[i].T_group_scan;
      scan.covariance.reset();
    }
  }
}

} // namespace pcl6d::slam6d
