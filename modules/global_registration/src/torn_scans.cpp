// SPDX-License-Identifier: BSD-3-Clause
#include "torn_scans.h"

#include <algorithm>
#include <map>
#include <utility>

namespace pcl6d::global_registration {

namespace {
/** Two scans that are apart from the others, mostly for want of evidence, say little of where
 * they are; but next to a torn scan they do. */
constexpr std::size_t kLeastRival = 3, kLeastRivalNextTo = 2;

/** \return whether a scan was joined by way of one of these, or one of them by way of it */
bool
isNextTo(std::size_t scan, const std::set<std::size_t>& scans, const JoinedBy& joined_by)
{
  const auto by = joined_by.find(scan);
  return (by != joined_by.end() && scans.count(by->second) > 0) ||
         std::any_of(scans.begin(), scans.end(), [&](std::size_t one) {
           const auto by_it = joined_by.find(one);
           return by_it != joined_by.end() && by_it->second == scan;
         });
}

void
addTornParts(const ScanList& scans,
             const ScanGroup& group,
             const JoinedBy& joined_by,
             const std::set<std::size_t>& each,
             std::set<std::size_t>& torn)
{
  for (const PlacedScan& member : group.members()) {
    ScanGroup part(scans), rest(scans);
    divide(group, joined_by, member.scan, part, rest);
    const auto& all = part.members();
    const auto count = static_cast<std::size_t>(
        std::count_if(all.begin(), all.end(), [&](const PlacedScan& one) {
          return each.count(one.scan) > 0;
        }));
    if (2 * count >= all.size() && 2 * all.size() <= group.members().size())
      for (const PlacedScan& one : all)
        torn.insert(one.scan);
  }
}
} // namespace

std::set<std::size_t>
tornScans(const ScanList& scans,
          const std::vector<const ScanGroup*>& groups,
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
      if (other != own && groups[other]->members().size() >= least &&
          has(scan, other))
        return true;
    return false;
  };
  for (std::size_t before = 1; torn.size() != before;) {
    before = torn.size();
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const PlacedScan& member : groups[g]->members())
        if (torn.count(member.scan) == 0 && is_torn(member.scan, g))
          torn.insert(member.scan);
  }
  const std::set<std::size_t> each = torn;
  for (const ScanGroup* group : groups)
    addTornParts(scans, *group, joined_by, each, torn);
  return torn;
}

} // namespace pcl6d::global_registration
