// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "group/joiner.h"
#include "group/torn_scans.h"

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

/** Number of scans of a block, evenly chosen, tested individually at the new pose: a large
 * block then takes no longer than a few scans. */
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
, hypotheses_(scans,
              options.max_ambiguity,
              options.num_threads,
              options.progress,
              options.memory)
, placement_(scans, hypotheses_, options.max_ambiguity, options.num_threads)
{
  grown_.joined.resize(scans.size());
  grown_.rejections.resize(scans.size());
}

void
Joiner::run(JoinedScans& result)
{
  const auto pairs = comparedPairs();
  ranked_ = rankPairs(
      scans_, pairs, options_.memory, options_.num_threads, options_.progress);
  result.pairs_compared = pairs.size();
  place(bestOfEach(
      ranked_, scans_.size(), options_.pairs_per_scan, [this](std::size_t scan) {
        return isKnown(scan);
      }));
  growGroups();
  mergeGroups();
  testAgain();
  const auto is_inside = [this](std::size_t scan) {
    return !grown_.groups.empty() && grown_.groups[0].scans.placeOf(scan).has_value();
  };
  place(furtherPairs(ranked_,
                     placed_,
                     scans_.size(),
                     options_.pairs_per_scan,
                     is_inside,
                     [this](std::size_t scan) { return isKnown(scan); }));
  testAgain();
  mergeGroups();
  leaveTorn();
  sortGroups();
  result.pairs_placed = placed_.size();
}

/** Every pair, or the requested pairs, without pairs with a known relative pose. */
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
Joiner::place(std::vector<RankedPair> pairs)
{
  if (const std::size_t most = options_.max_pairs;
      most > 0 && placed_.size() + pairs.size() > most)
    pairs.resize(most - std::min(most, placed_.size())); // the likeliest come first
  for (const auto& one : pairs)
    placed_.insert(one.scans);
  if (!pairs.empty())
    hypotheses_.add(pairs);
}

/** Removes members that fit another group as well, if the two groups were not merged, and the
 * other group, grown from all scans, is not much smaller than their own. */
void
Joiner::leaveTorn()
{
  std::vector<std::vector<std::size_t>> groups;
  std::vector<std::size_t> sizes(scans_.size()); // for each scan: of its group
  for (const JoinedGroup& group : grown_.groups) {
    groups.emplace_back();
    for (const PlacedScan& one : group.scans.members()) {
      groups.back().push_back(one.scan);
      sizes[one.scan] = group.scans.members().size();
    }
  }
  const auto has_place = [&](std::size_t scan, std::size_t other) {
    const JoinedGroup& group = grown_.groups[other];
    if (isKnown(scan) || !isComparable(group.most, sizes[scan]))
      return false;
    const auto places = placement_.placesOf(scan, group.scans);
    return !places.empty() &&
           placement_.settle(scan, places, group.scans, grown_.links).accepted;
  };
  const auto torn = tornScans(groups, grown_.joined_by, has_place);
  for (const std::size_t scan : torn) {
    if (isKnown(scan))
      continue;
    for (JoinedGroup& group : grown_.groups)
      group.scans.remove(scan);
    grown_.joined[scan] = false;
    grown_.rejections[scan] = RejectReason::kInTwoGroups;
  }
  if (!torn.empty())
    for (JoinedGroup& group : grown_.groups)
      cutDisconnected(group.scans);
  dropSingles();
}

/** \return whether a group of this size is a second explanation of the scans of a group, as a
 * second pose is of a scan */
bool
Joiner::isComparable(std::size_t size, std::size_t own) const
{
  return static_cast<double>(size) > options_.max_ambiguity * static_cast<double>(own);
}

/** A group with a single remaining scan is dissolved. */
void
Joiner::dropSingles()
{
  for (auto group = grown_.groups.begin(); group != grown_.groups.end();) {
    const auto& members = group->scans.members();
    if (members.size() > 1 || (members.size() == 1 && isKnown(members[0].scan))) {
      ++group;
      continue;
    }
    for (const PlacedScan& one : members) {
      grown_.joined[one.scan] = false;
      grown_.rejections[one.scan] = RejectReason::kNeighbourInTwoGroups;
    }
    group = grown_.groups.erase(group);
  }
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

/** Groups of scans with known poses, and groups from the strongest pairs of the others. */
void
Joiner::growGroups()
{
  growKnown();
  const bool has_known = !grown_.groups.empty();
  for (int round = 0;; ++round) {
    const auto seed = hypotheses_.strongestBeginning(grown_.joined, grown_.tried);
    if (!seed)
      break;
    if (grown_.groups.empty() || has_known || round > kGrownAlone)
      addGrown(*seed, scans_.size());
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
    grown_.groups.push_back({group, {}, scans_.size()}); // its scans stay
  }
}

/** Grows a group from a seed. A group grown earlier, from a stronger seed, may have begun with two
 * places that look alike, and then lacks the scans that contradict it: if the new group grows larger
 * than any before, with all scans at its disposal, it replaces them. */
void
Joiner::addLargest(const PlaceHypothesis& seed)
{
  const std::size_t largest = sizeOfLargest();
  Grown before = std::move(grown_);
  grown_ = {};
  grown_.joined.resize(scans_.size());
  grown_.rejections.resize(scans_.size());
  grown_.tried = before.tried;
  addGrown(seed, scans_.size());
  const std::size_t alone = sizeOfLargest();
  if (alone > largest)
    return;
  grown_ = std::move(before);
  addGrown(seed, alone);
}

std::size_t
Joiner::sizeOfLargest() const
{
  std::size_t largest = 0;
  for (const JoinedGroup& group : grown_.groups)
    largest = std::max(largest, group.scans.members().size());
  return largest;
}

/** \param[in] most number of scans that the group could have */
void
Joiner::addGrown(const PlaceHypothesis& seed, std::size_t most)
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
    grown_.groups.push_back({part, {}, std::max(most, part.members().size())});
  grown_.groups.push_back({group, {}, std::max(most, group.members().size())});
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

/** \return the number of a known group; other groups rank last */
std::size_t
Joiner::rankOf(const ScanGroup& group) const
{
  const std::size_t first = group.members().front().scan;
  return isKnown(first) ? known_[first]->group : static_cast<std::size_t>(-1);
}

/** Groups with known poses first, then by size. */
void
Joiner::sortGroups()
{
  std::stable_sort(
      grown_.groups.begin(), grown_.groups.end(), [this](const auto& a, const auto& b) {
        const std::size_t rank_a = rankOf(a.scans), rank_b = rankOf(b.scans);
        return rank_a != rank_b ? rank_a < rank_b
                                : a.scans.members().size() > b.scans.members().size();
      });
}

/** Joins groups with a unique pose relative to each other. */
void
Joiner::mergeGroups()
{
  sortGroups();
  for (std::size_t to = 0; to < grown_.groups.size(); ++to)
    for (std::size_t from = to + 1; from < grown_.groups.size();)
      if (merge(grown_.groups[to], grown_.groups[from])) {
        grown_.groups.erase(grown_.groups.begin() + static_cast<std::ptrdiff_t>(from));
        from = to + 1; // further groups may have a pose relative to the union
      }
      else
        ++from;
}

bool
Joiner::merge(JoinedGroup& to, JoinedGroup& from)
{
  from.rejection = {};
  const auto place = onlyPlaceOfBlock(to.scans,
                                      from.scans,
                                      hypotheses_,
                                      options_.max_ambiguity,
                                      options_.num_threads,
                                      from.rejection);
  if (!place)
    return false;
  Eigen::Isometry3d T;
  from.rejection = settleBlock(to.scans, from.scans, *place, T);
  if (from.rejection)
    return false;
  for (const auto& one : from.scans.members())
    to.scans.add(one.scan, T * one.T_group_scan);
  to.most = std::max({to.most, from.most, to.scans.members().size()});
  return true;
}

/** Matches the scan of a block with the largest overlap, and tests several more of its scans.
 * \return the contradiction, in words; empty if accepted */
Rejection
Joiner::settleBlock(const ScanGroup& to,
                    const ScanGroup& block,
                    const BlockPlace& place,
                    Eigen::Isometry3d& T_group_block)
{
  const PlacedScan& fixing = block.members()[place.fixing];
  Place at;
  at.T_group_scan = place.T_group_block * fixing.T_group_scan;
  at.support = place.support;
  const Settled settled = placement_.settle(fixing.scan, {at}, to, grown_.links);
  if (!settled.accepted)
    return settled.rejection;
  T_group_block = settled.best.T_group_scan * fixing.T_group_scan.inverse();
  if (Rejection contradiction = contradictionOf(block, T_group_block, to))
    return contradiction;
  grown_.links.insert(grown_.links.end(), settled.links.begin(), settled.links.end());
  return {};
}

/** \return the contradiction between a group and a block, from several scans of the block;
 * empty if accepted */
Rejection
Joiner::contradictionOf(const ScanGroup& block,
                        const Eigen::Isometry3d& T_group_block,
                        const ScanGroup& group) const
{
  const std::size_t count = block.members().size();
  const std::size_t asked = std::min(count, kAskedOfBlock);
  Rejection contradiction;
  for (std::size_t k = 0; k < asked && !contradiction; ++k) {
    const PlacedScan& one = block.members()[k * count / asked];
    contradiction = placement_.rejectionOf(one.scan,
                                           T_group_block * one.T_group_scan,
                                           group,
                                           grown_.links,
                                           PlaceNeeds::kNoContradiction);
  }
  return contradiction;
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

} // namespace pcl6d::global_registration
