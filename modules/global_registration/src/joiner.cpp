// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "joiner.h"
#include "torn_scans.h"

#include <pcl6d/common/parallel.h>

#include <algorithm>
#include <map>
#include <utility>

namespace pcl6d::global_registration {

namespace {
/** So often scans are judged again without themselves. */
constexpr int kRechecks = 3;

/** So many scans of a block that finds its place are asked one by one, evenly among all: each
 * has a say, and the largest blocks take no longer than a few scans. */
constexpr std::size_t kAskedOfBlock = 12;
} // namespace

Joiner::Joiner(const ScanList& scans,
               const JoinOptions& options,
               Known known,
               std::vector<ScanPlaces> pairs)
: scans_(scans)
, options_(options)
, known_(std::move(known))
, pairs_(std::move(pairs))
, hypotheses_(scans, options.max_ambiguity, options.num_threads, options.progress)
, placement_(scans, hypotheses_, options.max_ambiguity, options.num_threads)
, joined_(scans.size())
, reasons_(scans.size())
{}

void
Joiner::run(JoinedScans& result)
{
  const auto pairs = comparedPairs();
  ranked_ = rankPairs(scans_, pairs, options_.num_threads, options_.progress);
  result.pairs_compared = pairs.size();
  place(bestOfEach(
      ranked_, scans_.size(), options_.pairs_per_scan, [this](std::size_t scan) {
        return isKnown(scan);
      }));
  growKnown();
  while (const auto seed = hypotheses_.strongestBeginning(joined_, tried_))
    addGrown(*seed);
  mergeGroups();
  judgeAgain();
  const auto is_inside = [this](std::size_t scan) {
    return !groups_.empty() && groups_[0].scans.placeOf(scan).has_value();
  };
  place(furtherPairs(
      ranked_, placed_, scans_.size(), options_.pairs_per_scan, is_inside));
  judgeAgain();
  mergeGroups();
  leaveTorn();
  sortGroups();
  result.pairs_placed = placed_.size();
}

/** All, or those asked for, but for those whose relative place is known. */
std::vector<ScanPlaces>
Joiner::comparedPairs() const
{
  const auto is_open = [this](std::size_t i, std::size_t j) {
    return !isKnown(i) || !isKnown(j) || known_[i]->group != known_[j]->group;
  };
  std::vector<ScanPlaces> pairs;
  for (const auto& [i, j] : pairs_)
    if (is_open(i, j))
      pairs.emplace_back(i, j);
  for (std::size_t j = 1; j < scans_.size() && pairs_.empty(); ++j)
    for (std::size_t i = 0; i < j; ++i)
      if (is_open(i, j))
        pairs.emplace_back(i, j);
  return pairs;
}

void
Joiner::place(const std::vector<RankedPair>& pairs)
{
  for (const auto& one : pairs)
    placed_.insert(one.scans);
  if (!pairs.empty())
    hypotheses_.add(pairs);
}

/** Members that another group would take as well, though the two are not one, are in neither. */
void
Joiner::leaveTorn()
{
  std::vector<std::vector<std::size_t>> groups;
  for (const JoinedGroup& group : groups_) {
    groups.emplace_back();
    for (const PlacedScan& one : group.scans.members())
      groups.back().push_back(one.scan);
  }
  const auto has_place = [&](std::size_t scan, std::size_t group) {
    if (isKnown(scan))
      return false;
    const auto places = placement_.placesOf(scan, groups_[group].scans);
    return !places.empty() &&
           placement_.settle(scan, places, groups_[group].scans, links_).accepted;
  };
  const auto torn = tornScans(groups, joined_by_, has_place);
  for (const std::size_t scan : torn) {
    if (isKnown(scan))
      continue;
    for (JoinedGroup& group : groups_)
      group.scans.remove(scan);
    joined_[scan] = false;
    reasons_[scan] = "it has a place in two groups that are not one";
  }
  if (!torn.empty())
    for (JoinedGroup& group : groups_)
      cutLoose(group.scans);
  dropSingles();
}

/** One scan that is left of a group is none. */
void
Joiner::dropSingles()
{
  for (auto group = groups_.begin(); group != groups_.end();) {
    const auto& members = group->scans.members();
    if (members.size() > 1 || (members.size() == 1 && isKnown(members[0].scan))) {
      ++group;
      continue;
    }
    for (const PlacedScan& one : members) {
      joined_[one.scan] = false;
      reasons_[one.scan] = "what it was joined to has a place in two groups";
    }
    group = groups_.erase(group);
  }
}

/** All groups once more, as scans that were placed later may know better. */
void
Joiner::judgeAgain()
{
  for (JoinedGroup& group : groups_)
    for (int k = 0; k < kRechecks; ++k) {
      const bool is_changed = recheck(group.scans);
      if (grow(group.scans) == 0 && !is_changed)
        break;
    }
}

/** The groups of scans whose places are known, in the order of their numbers. */
void
Joiner::growKnown()
{
  std::map<std::size_t, ScanGroup> known;
  for (std::size_t i = 0; i < known_.size(); ++i)
    if (known_[i]) {
      known.emplace(known_[i]->group, ScanGroup(scans_))
          .first->second.add(i, known_[i]->T_group_scan);
      joined_[i] = true;
    }
  for (auto& [number, group] : known) {
    grow(group);
    groups_.push_back({group, ""});
  }
}

void
Joiner::addGrown(const PlaceHypothesis& seed)
{
  ScanGroup group(scans_);
  group.add(seed.first, Eigen::Isometry3d::Identity());
  group.add(seed.second, seed.T_first_second);
  tried_.insert({seed.first, seed.second});
  joined_[seed.first] = joined_[seed.second] = true;
  grow(group);
  for (int k = 0; k < kRechecks && recheck(group); ++k)
    grow(group);
  cutLoose(group);
  const auto parts = splitOff(
      group, joined_by_, hypotheses_, options_.max_ambiguity, options_.num_threads);
  for (const ScanGroup& part : parts)
    groups_.push_back({part, ""});
  groups_.push_back({group, ""});
}

/** Members that links do not tie to the others leave the group. */
void
Joiner::cutLoose(ScanGroup& group)
{
  if (group.members().size() < 3)
    return;
  for (const auto& [scan, why] : untiedOf(group, joined_by_, options_.num_threads)) {
    if (isKnown(scan))
      continue;
    group.remove(scan);
    joined_[scan] = false;
    reasons_[scan] = why;
  }
}

/** \return the number of a known group, those of all others behind them */
std::size_t
Joiner::rankOf(const ScanGroup& group) const
{
  const std::size_t first = group.members().front().scan;
  return isKnown(first) ? known_[first]->group : static_cast<std::size_t>(-1);
}

/** Those of known places first, then by size. */
void
Joiner::sortGroups()
{
  std::stable_sort(
      groups_.begin(), groups_.end(), [this](const auto& a, const auto& b) {
        const std::size_t rank_a = rankOf(a.scans), rank_b = rankOf(b.scans);
        return rank_a != rank_b ? rank_a < rank_b
                                : a.scans.members().size() > b.scans.members().size();
      });
}

/** Joins groups that have one place on each other. */
void
Joiner::mergeGroups()
{
  sortGroups();
  for (std::size_t to = 0; to < groups_.size(); ++to)
    for (std::size_t from = to + 1; from < groups_.size();)
      if (merge(groups_[to], groups_[from])) {
        groups_.erase(groups_.begin() + static_cast<std::ptrdiff_t>(from));
        from = to + 1; // others may have a place on both together
      }
      else
        ++from;
}

bool
Joiner::merge(JoinedGroup& to, JoinedGroup& from)
{
  from.reason.clear();
  const auto place = onlyPlaceOfBlock(to.scans,
                                      from.scans,
                                      hypotheses_,
                                      options_.max_ambiguity,
                                      options_.num_threads,
                                      from.reason);
  if (!place)
    return false;
  Eigen::Isometry3d T;
  from.reason = settleBlock(to.scans, from.scans, *place, T);
  if (!from.reason.empty())
    return false;
  for (const auto& one : from.scans.members())
    to.scans.add(one.scan, T * one.T_group_scan);
  return true;
}

/** Matches the scan of a block that meets most, and asks others what they have against it.
 * \return that, in words, or nothing */
std::string
Joiner::settleBlock(const ScanGroup& to,
                    const ScanGroup& block,
                    const BlockPlace& place,
                    Eigen::Isometry3d& T_group_block)
{
  const PlacedScan& fixing = block.members()[place.fixing];
  Place at;
  at.T_group_scan = place.T_group_block * fixing.T_group_scan;
  at.support = place.support;
  const Settled settled = placement_.settle(fixing.scan, {at}, to, links_);
  if (!settled.accepted)
    return settled.reason;
  T_group_block = settled.best.T_group_scan * fixing.T_group_scan.inverse();
  const std::string objection = contradictionOf(block, T_group_block, to);
  if (!objection.empty())
    return objection;
  links_.insert(links_.end(), settled.links.begin(), settled.links.end());
  return "";
}

/** \return what a group has against a block there, some of whose scans are asked; or nothing */
std::string
Joiner::contradictionOf(const ScanGroup& block,
                        const Eigen::Isometry3d& T_group_block,
                        const ScanGroup& group) const
{
  const std::size_t count = block.members().size();
  const std::size_t asked = std::min(count, kAskedOfBlock);
  std::string objection;
  for (std::size_t k = 0; k < asked && objection.empty(); ++k) {
    const PlacedScan& one = block.members()[k * count / asked];
    objection = placement_.objectionTo(one.scan,
                                       T_group_block * one.T_group_scan,
                                       group,
                                       links_,
                                       PlaceNeeds::kNoObjection);
  }
  return objection;
}

/** Joins what can be joined. \return the number of scans */
std::size_t
Joiner::grow(ScanGroup& group)
{
  const std::size_t before = group.members().size();
  std::vector<std::vector<Place>> places(scans_.size());
  std::vector<bool> is_known(scans_.size(), false), is_refused(scans_.size(), false);
  while (true) {
    std::vector<std::size_t> wanted;
    for (std::size_t u = 0; u < scans_.size(); ++u)
      if (!joined_[u] && !is_known[u])
        wanted.push_back(u);
    parallelFor(wanted.size(), options_.num_threads, [&](std::size_t k) {
      places[wanted[k]] = placement_.placesOf(wanted[k], group);
    });
    for (const std::size_t u : wanted)
      is_known[u] = true;
    const std::size_t next = clearest(places, is_refused);
    if (next == scans_.size())
      return group.members().size() - before;
    Settled settled = placement_.settle(next, places[next], group, links_);
    if (!settled.accepted) {
      is_refused[next] = true;
      reasons_[next] = settled.reason;
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
  joined_by_[scan] = group.members()[settled.best.support.met.front()].scan;
  group.add(scan, settled.best.T_group_scan);
  joined_[scan] = true;
  reasons_[scan].clear();
  links_.insert(links_.end(), settled.links.begin(), settled.links.end());
}

/** \return the scan that is not joined, nor refused, with the best place */
std::size_t
Joiner::clearest(const std::vector<std::vector<Place>>& places,
                 const std::vector<bool>& is_refused) const
{
  std::size_t best = scans_.size();
  for (std::size_t u = 0; u < scans_.size(); ++u)
    if (!joined_[u] && !is_refused[u] && !places[u].empty() &&
        (best == scans_.size() ||
         places[u].front().support.score > places[best].front().support.score))
      best = u;
  return best;
}

/** Judges all members without themselves; those whose place is not clear are loose again.
 * \return whether one is */
bool
Joiner::recheck(ScanGroup& group)
{
  bool is_changed = false;
  const std::vector<PlacedScan> members = group.members();
  for (std::size_t k = 0; k < members.size() && group.members().size() > 2; ++k) {
    const std::size_t scan = members[k].scan;
    if (k == 0 || isKnown(scan))
      continue; // the frame of the group
    auto places = placement_.placesOf(scan, group);
    if (places.empty())
      continue;
    const Settled settled = placement_.settle(scan, places, group, links_);
    if (settled.accepted && areSamePlace(settled.best.T_group_scan,
                                         members[k].T_group_scan,
                                         scans_[scan]->cell())) {
      continue;
    }
    group.remove(scan);
    joined_[scan] = false;
    reasons_[scan] =
        settled.accepted ? "without it, another place is better" : settled.reason;
    is_changed = true;
  }
  return is_changed;
}

} // namespace pcl6d::global_registration
