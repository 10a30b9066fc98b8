// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "group/joiner.h"
#include "group/torn_scans.h"

#include <algorithm>
#include <utility>

namespace pcl6d::global_registration {

namespace {
/** Number of scans of a block, evenly chosen, tested individually at the new pose: a large
 * block then takes no longer than a few scans. */
constexpr std::size_t kAskedOfBlock = 12;

/** Number of groups grown from all scans because they compete for scans of another group. Each takes
 * about a third of the time of everything else. */
constexpr int kCompetitors = 2;
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
  result.pairs_paid.assign(paid_.begin(), paid_.end());
  result.pairs_left_out = left_out_.size();
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
Joiner::place(const std::vector<RankedPair>& pairs)
{
  std::vector<RankedPair> taken; // the likeliest come first
  for (const auto& one : pairs) {
    const bool is_free =
        options_.free_pairs && options_.free_pairs->count(one.scans) > 0;
    const bool is_paid = paid_.count(one.scans) > 0;
    if (!is_free && !is_paid && options_.max_pairs > 0 &&
        paid_.size() >= options_.max_pairs) {
      left_out_.insert(one.scans);
      continue;
    }
    if (!is_free)
      paid_.insert(one.scans);
    placed_.insert(one.scans);
    taken.push_back(one);
  }
  if (!taken.empty())
    hypotheses_.add(taken);
}

/** Removes members that have another place in another group, if the two groups were not merged. */
void
Joiner::leaveTorn()
{
  std::vector<std::vector<std::size_t>> groups;
  std::vector<const JoinedGroup*> own(scans_.size()); // of each scan
  for (const JoinedGroup& group : grown_.groups) {
    groups.emplace_back();
    for (const PlacedScan& one : group.scans.members()) {
      groups.back().push_back(one.scan);
      own[one.scan] = &group;
    }
  }
  const auto has_place = [&](std::size_t scan, std::size_t other) {
    return !isKnown(scan) && isAnotherPlace(scan, *own[scan], grown_.groups[other]);
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

/** \return whether a scan of a group fits into another group, too, and this contradicts its pose. A
 * group does that only if it is not much smaller than the own one once both are grown from all
 * scans. If most of its scans have the same relative poses in both, the two are one group, found
 * twice, and these scans stay. */
bool
Joiner::isAnotherPlace(std::size_t scan, const JoinedGroup& own, JoinedGroup& other)
{
  if (!isLargeEnough(other, own))
    return false;
  const auto places = placement_.placesOf(scan, other.scans);
  if (places.empty() ||
      !placement_.settle(scan, places, other.scans, grown_.links).accepted)
    return false;
  const auto& members = other.scans.members();
  if (hasKnown() || members.size() < 2)
    return true;
  if (!other.alone) {
    if (++num_competitors_ > kCompetitors)
      return true;
    PlaceHypothesis seed;
    seed.first = members[0].scan;
    seed.second = members[1].scan;
    seed.T_first_second = members[0].T_group_scan.inverse() * members[1].T_group_scan;
    other.alone = grownAlone(seed).groups.back().alone;
  }
  const auto are_same =
      [this](std::size_t one, const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
        return areSamePlace(a, b, scans_[one]->cell());
      };
  return isLargeEnough(other, own) &&
         placedAlike(own.scans.members(), *other.alone, are_same).count(scan) == 0;
}

bool
Joiner::isLargeEnough(const JoinedGroup& other, const JoinedGroup& own) const
{
  const auto alone =
      other.alone ? std::make_optional(other.alone->size()) : std::nullopt;
  return global_registration::mayExplain(other.scans.members().size(),
                                         alone,
                                         own.scans.members().size(),
                                         options_.max_ambiguity);
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
  if (to.alone && from.alone && from.alone->size() > to.alone->size())
    to.alone = std::move(from.alone);
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

} // namespace pcl6d::global_registration
