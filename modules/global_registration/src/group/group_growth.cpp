// SPDX-License-Identifier: BSD-3-Clause
// How groups grow from seeds, a part of Joiner.
#include "group/joiner.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <map>
#include <utility>

namespace pcl6d::global_registration {

namespace {
/** Rounds of tests of each scan against the rest of its group. */
constexpr int kRechecks = 3;

/** Number of groups that are also grown from all scans. Each takes about as long as the first group,
 * a third of the whole time. */
constexpr int kGrownAlone = 2;

/** \return the scans of the largest group, and their poses */
std::vector<PlacedScan>
largestOf(const std::vector<JoinedGroup>& groups)
{
  std::vector<PlacedScan> largest;
  for (const JoinedGroup& group : groups)
    if (group.scans.members().size() > largest.size())
      largest = group.scans.members();
  return largest;
}
} // namespace

/** Groups of scans with known poses, and groups from the strongest pairs of the others. */
void
Joiner::growGroups()
{
  growKnown();
  for (int round = 0;; ++round) {
    const auto seed = hypotheses_.strongestBeginning(grown_.joined, grown_.tried);
    if (!seed)
      break;
    if (hasKnown() || round > kGrownAlone)
      addGrown(*seed);
    else
      addLargest(*seed);
  }
}

/** The groups of scans with known poses, in the order of their numbers. */
void
Joiner::growKnown()
{
  std::map<std::size_t, ScanGroup> known;
  for (std::size_t i = 0; i < known_.size(); ++i)
    if (known_[i]) {
      known.emplace(known_[i]->group, ScanGroup(scans_))
          .first->second.add(i, known_[i]->T_group_scan);
      grown_.joined[i] = true;
    }
  for (auto& [number, group] : known) {
    grow(group);
    grown_.groups.push_back({group, {}, {}});
  }
}

/** Grows a group from a seed. A group grown earlier, from a stronger seed, may have begun with two
 * places that look alike, and then lacks the scans that contradict it: if the new group grows larger
 * than any before, with all scans at its disposal, it replaces them. */
void
Joiner::addLargest(const PlaceHypothesis& seed)
{
  Grown alone = grownAlone(seed);
  auto& scans = alone.groups.back().alone;
  if (scans->size() > largestOf(grown_.groups).size())
    grown_ = std::move(alone);
  else
    addGrown(seed, std::move(scans));
}

/** Grows a group from a seed as if there were no other. \return the group, last, and what it
 * was split into */
Joiner::Grown
Joiner::grownAlone(const PlaceHypothesis& seed)
{
  Grown alone;
  alone.joined.resize(scans_.size());
  alone.rejections.resize(scans_.size());
  alone.tried = grown_.tried;
  std::swap(grown_, alone);
  addGrown(seed);
  std::swap(grown_, alone);
  alone.groups.back().alone = largestOf(alone.groups);
  return alone;
}

/** \param[in] alone as JoinedGroup::alone, if known */
void
Joiner::addGrown(const PlaceHypothesis& seed,
                 std::optional<std::vector<PlacedScan>> alone)
{
  ScanGroup group(scans_);
  group.add(seed.first, Eigen::Isometry3d::Identity());
  group.add(seed.second, seed.T_first_second);
  grown_.tried.insert({seed.first, seed.second});
  grown_.joined[seed.first] = grown_.joined[seed.second] = true;
  grow(group);
  for (int k = 0; k < kRechecks && recheck(group); ++k)
    grow(group);
  cutDisconnected(group);
  const auto parts = splitOff(group,
                              grown_.joined_by,
                              hypotheses_,
                              options_.max_ambiguity,
                              options_.num_threads);
  for (const ScanGroup& part : parts)
    grown_.groups.push_back({part, {}, {}});
  grown_.groups.push_back({group, {}, std::move(alone)});
}

/** Joins scans while possible. \return the number of joined scans */
std::size_t
Joiner::grow(ScanGroup& group)
{
  const std::size_t before = group.members().size();
  std::vector<std::vector<Place>> places(scans_.size());
  std::vector<bool> is_known(scans_.size(), false), is_refused(scans_.size(), false);
  while (true) {
    std::vector<std::size_t> wanted;
    for (std::size_t u = 0; u < scans_.size(); ++u)
      if (!grown_.joined[u] && !is_known[u])
        wanted.push_back(u);
    parallelFor(wanted.size(), options_.num_threads, [&](std::size_t k) {
      places[wanted[k]] = placement_.placesOf(wanted[k], group);
    });
    for (const std::size_t u : wanted)
      is_known[u] = true;
    const std::size_t next = clearest(places, is_refused);
    if (next == scans_.size())
      return group.members().size() - before;
    Settled settled = placement_.settle(next, places[next], group, grown_.links);
    if (!settled.accepted) {
      is_refused[next] = true;
      grown_.rejections[next] = settled.rejection;
      continue;
    }
    join(next, settled, group);
    for (const std::size_t h : hypotheses_.of(next)) {
      const PlaceHypothesis& one = hypotheses_.all()[h];
      const std::size_t other = one.first == next ? one.second : one.first;
      is_known[other] = is_refused[other] = false;
    }
  }
}

void
Joiner::join(std::size_t scan, const Settled& settled, ScanGroup& group)
{
  grown_.joined_by[scan] = group.members()[settled.best.support.met.front()].scan;
  group.add(scan, settled.best.T_group_scan);
  grown_.joined[scan] = true;
  grown_.rejections[scan] = {};
  grown_.links.insert(grown_.links.end(), settled.links.begin(), settled.links.end());
}

/** \return the scan with the best pose among scans neither joined nor rejected */
std::size_t
Joiner::clearest(const std::vector<std::vector<Place>>& places,
                 const std::vector<bool>& is_refused) const
{
  std::size_t best = scans_.size();
  for (std::size_t u = 0; u < scans_.size(); ++u)
    if (!grown_.joined[u] && !is_refused[u] && !places[u].empty() &&
        (best == scans_.size() ||
         places[u].front().support.score > places[best].front().support.score))
      best = u;
  return best;
}

/** Tests each member against the rest; members with an unclear pose leave the group.
 * \return whether any member left */
bool
Joiner::recheck(ScanGroup& group)
{
  bool is_changed = false;
  const std::vector<PlacedScan> members = group.members();
  for (std::size_t k = 0; k < members.size() && group.members().size() > 2; ++k) {
    const std::size_t scan = members[k].scan;
    if (k == 0 || isKnown(scan))
      continue; // defines the frame of the group
    auto places = placement_.placesOf(scan, group);
    if (places.empty())
      continue;
    const Settled settled = placement_.settle(scan, places, group, grown_.links);
    if (settled.accepted && areSamePlace(settled.best.T_group_scan,
                                         members[k].T_group_scan,
                                         scans_[scan]->cell())) {
      continue;
    }
    group.remove(scan);
    grown_.joined[scan] = false;
    grown_.rejections[scan] = settled.accepted
                                  ? Rejection(RejectReason::kBetterPoseElsewhere)
                                  : settled.rejection;
    is_changed = true;
  }
  return is_changed;
}

/** Tests every group once more, since later scans may contradict its members. */
void
Joiner::testAgain()
{
  for (JoinedGroup& group : grown_.groups)
    for (int k = 0; k < kRechecks; ++k) {
      const bool is_changed = recheck(group.scans);
      if (grow(group.scans) == 0 && !is_changed)
        break;
    }
}

/** Members disconnected from the rest by the link test leave the group. */
void
Joiner::cutDisconnected(ScanGroup& group)
{
  if (group.members().size() < 3)
    return;
  for (const auto& [scan, why] :
       disconnectedOf(group, grown_.joined_by, options_.num_threads)) {
    if (isKnown(scan))
      continue;
    group.remove(scan);
    grown_.joined[scan] = false;
    grown_.rejections[scan] = why;
  }
}

} // namespace pcl6d::global_registration
