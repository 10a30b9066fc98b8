// SPDX-License-Identifier: BSD-3-Clause
#include "group/torn_scans.h"

#include <algorithm>
#include <map>
#include <utility>

namespace pcl6d::global_registration {

namespace {
/** Least size of a second group: two separate scans usually lack evidence, and give little
 * information; next to a torn scan two are enough. */
constexpr std::size_t kLeastRival = 3, kLeastRivalNextTo = 2;

/** \return whether a scan was joined by way of one of `scans`, or one of `scans` by way of the
 * scan */
bool
isNextTo(std::size_t scan,
         const std::set<std::size_t>& scans,
         const JoinedBy& joined_by)
{
  const auto by = joined_by.find(scan);
  return (by != joined_by.end() && scans.count(by->second) > 0) ||
         std::any_of(scans.begin(), scans.end(), [&](std::size_t one) {
           const auto by_it = joined_by.find(one);
           return by_it != joined_by.end() && by_it->second == scan;
         });
}

/** \return the parts torn as a whole: at most half of the group */
std::set<std::size_t>
tornParts(const std::vector<std::size_t>& group,
          const JoinedBy& joined_by,
          const std::set<std::size_t>& torn)
{
  std::set<std::size_t> parts;
  for (const std::size_t scan : group) {
    const std::set<std::size_t> part = partBehind(scan, group, joined_by);
    const auto count = static_cast<std::size_t>(
        std::count_if(part.begin(), part.end(), [&](std::size_t one) {
          return torn.count(one) > 0;
        }));
    if (2 * count >= part.size() && 2 * part.size() <= group.size())
      parts.insert(part.begin(), part.end());
  }
  return parts;
}
} // namespace

std::set<std::size_t>
tornScans(const std::vector<std::vector<std::size_t>>& groups,
          const JoinedBy& joined_by,
          const std::function<bool(std::size_t scan, std::size_t group)>& has_place)
{
  std::set<std::size_t> torn;
  std::map<std::pair<std::size_t, std::size_t>, bool> asked; // scan, group
  const auto has = [&](std::size_t scan, std::size_t group) {
    const auto [answer, is_new] = asked.try_emplace({scan, group}, false);
    if (is_new)
      answer->second = has_place(scan, group);
    return answer->second;
  };
  const auto is_torn = [&](std::size_t scan, std::size_t own) {
    const std::size_t least =
        isNextTo(scan, torn, joined_by) ? kLeastRivalNextTo : kLeastRival;
    for (std::size_t other = 0; other < groups.size(); ++other)
      if (other != own && groups[other].size() >= least && has(scan, other))
        return true;
    return false;
  };
  for (std::size_t before = 1; torn.size() != before;) {
    before = torn.size();
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const std::size_t scan : groups[g])
        if (torn.count(scan) == 0 && is_torn(scan, g))
          torn.insert(scan);
  }
  std::set<std::size_t> all = torn;
  for (const auto& group : groups)
    all.merge(tornParts(group, joined_by, torn));
  return all;
}

bool
mayExplain(std::size_t size,
           std::optional<std::size_t> alone,
           std::size_t own,
           double max_ambiguity)
{
  return !alone || static_cast<double>(std::max(size, *alone)) >
                       max_ambiguity * static_cast<double>(own);
}

std::set<std::size_t>
placedAlike(const std::vector<PlacedScan>& group,
            const std::vector<PlacedScan>& other,
            const std::function<bool(std::size_t scan,
                                     const Eigen::Isometry3d& a,
                                     const Eigen::Isometry3d& b)>& are_same)
{
  std::map<std::size_t, Eigen::Isometry3d> placed; // of the group
  for (const PlacedScan& one : group)
    placed[one.scan] = one.T_group_scan;
  std::set<std::size_t> most;
  for (const PlacedScan& fixing : other) {
    const auto at = placed.find(fixing.scan);
    if (at == placed.end())
      continue;
    const Eigen::Isometry3d T_group_other = at->second * fixing.T_group_scan.inverse();
    std::set<std::size_t> alike;
    for (const PlacedScan& one : other)
      if (const auto place = placed.find(one.scan);
          place != placed.end() &&
          are_same(one.scan, place->second, T_group_other * one.T_group_scan))
        alike.insert(one.scan);
    if (alike.size() > most.size())
      most = std::move(alike);
  }
  return 2 * most.size() > other.size() ? most : std::set<std::size_t>{};
}

} // namespace pcl6d::global_registration
