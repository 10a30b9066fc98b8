// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "content_order.h"
#include "group_ties.h"
#include "joint_placement.h"
#include "place_hypotheses.h"
#include "scan_blocks.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/global_registration/scan_joiner.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace pcl6d {
using namespace global_registration;

namespace {
/** So often scans are judged again without themselves. */
constexpr int kRechecks = 3;

/** One run of joinScans(); scans in the order of their content. */
class Joiner {
public:
  Joiner(const ScanList& scans,
         const JoinOptions& options,
         std::vector<std::optional<Eigen::Isometry3d>> known)
  : scans_(scans)
  , options_(options)
  , known_(std::move(known))
  , joined_(scans.size())
  , reasons_(scans.size())
  {}

  void
  run(JoinedScans& result)
  {
    std::vector<ScanPlaces> pairs;
    for (std::size_t j = 1; j < scans_.size(); ++j)
      for (std::size_t i = 0; i < j; ++i)
        pairs.emplace_back(i, j);
    ranked_ = rankPairs(scans_, pairs, options_.num_threads, options_.progress);
    result.pairs_compared = pairs.size();
    hypotheses_.emplace(
        scans_, options_.max_ambiguity, options_.num_threads, options_.progress);
    placement_.emplace(
        scans_, *hypotheses_, options_.max_ambiguity, options_.num_threads);
    place(bestOfEach(ranked_, scans_.size(), options_.pairs_per_scan));
    growKnown();
    while (const auto seed = hypotheses_->strongestBeginning(joined_, tried_))
      addGrown(*seed);
    mergeGroups();
    judgeAgain();
    const auto is_inside = [this](std::size_t scan) {
      return !groups_.empty() && groups_[0].placeOf(scan).has_value();
    };
    place(furtherPairs(
        ranked_, placed_, scans_.size(), options_.pairs_per_scan, is_inside));
    judgeAgain();
    mergeGroups();
    sortGroups();
    result.pairs_placed = placed_.size();
  }

  const std::vector<ScanGroup>&
  groups() const
  {
    return groups_;
  }
  const std::string&
  reasonOf(std::size_t scan) const
  {
    return reasons_[scan];
  }

  bool
  isKnown(std::size_t scan) const
  {
    return scan < known_.size() && known_[scan].has_value();
  }

private:
  void
  place(const std::vector<RankedPair>& pairs)
  {
    for (const auto& one : pairs)
      placed_.insert(one.scans);
    if (!pairs.empty())
      hypotheses_->add(pairs);
  }

  /** All groups once more, as scans that were placed later may know better. */
  void
  judgeAgain()
  {
    for (ScanGroup& group : groups_)
      for (int k = 0; k < kRechecks; ++k) {
        const bool is_changed = recheck(group);
        if (grow(group) == 0 && !is_changed)
          break;
      }
  }

  /** The group of scans whose poses are known. */
  void
  growKnown()
  {
    ScanGroup group(scans_);
    for (std::size_t i = 0; i < known_.size(); ++i)
      if (known_[i]) {
        group.add(i, *known_[i]);
        joined_[i] = true;
      }
    if (group.members().empty())
      return;
    grow(group);
    groups_.push_back(group);
  }

  void
  addGrown(const PlaceHypothesis& seed)
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
        group, joined_by_, *hypotheses_, options_.max_ambiguity, options_.num_threads);
    groups_.insert(groups_.end(), parts.begin(), parts.end());
    groups_.push_back(group);
  }

  /** Members that links do not tie to the others leave the group. */
  void
  cutLoose(ScanGroup& group)
  {
    if (group.members().size() < 3)
      return;
    for (const auto& [scan, why] : untiedOf(group, joined_by_, options_.num_threads)) {
      group.remove(scan);
      joined_[scan] = false;
      reasons_[scan] = why;
    }
  }

  /** That of known poses first, then by size. */
  void
  sortGroups()
  {
    std::stable_sort(
        groups_.begin(), groups_.end(), [this](const auto& a, const auto& b) {
          const bool a_is_known = isKnown(a.members().front().scan);
          const bool b_is_known = isKnown(b.members().front().scan);
          return a_is_known != b_is_known ? a_is_known
                                          : a.members().size() > b.members().size();
        });
  }

  /** Joins groups that have one place on each other. */
  void
  mergeGroups()
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
  merge(ScanGroup& to, const ScanGroup& from)
  {
    const auto place = onlyPlaceOfBlock(
        to, from, *hypotheses_, options_.max_ambiguity, options_.num_threads);
    if (!place)
      return false;
    const PlacedScan& fixing = from.members()[place->fixing];
    const std::size_t scan = fixing.scan;
    Place at;
    at.T_group_scan = place->T_group_block * fixing.T_group_scan;
    at.support = place->support;
    const Settled settled = placement_->settle(scan, {at}, to, links_);
    if (!settled.accepted)
      return false;
    const Eigen::Isometry3d T =
        settled.best.T_group_scan * fixing.T_group_scan.inverse();
    links_.insert(links_.end(), settled.links.begin(), settled.links.end());
    for (const auto& one : from.members())
      to.add(one.scan, T * one.T_group_scan);
    return true;
  }

  /** Joins what can be joined. \return the number of scans */
  std::size_t
  grow(ScanGroup& group)
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
        places[wanted[k]] = placement_->placesOf(wanted[k], group);
      });
      for (const std::size_t u : wanted)
        is_known[u] = true;
      const std::size_t next = clearest(places, is_refused);
      if (next == scans_.size())
        return group.members().size() - before;
      Settled settled = placement_->settle(next, places[next], group, links_);
      if (!settled.accepted) {
        is_refused[next] = true;
        reasons_[next] = settled.reason;
        continue;
      }
      join(next, settled, group);
      for (const std::size_t h : hypotheses_->of(next)) {
        const PlaceHypothesis& one = hypotheses_->all()[h];
        const std::size_t other = one.first == next ? one.second : one.first;
        is_known[other] = is_refused[other] = false;
      }
    }
  }

  void
  join(std::size_t scan, const Settled& settled, ScanGroup& group)
  {
    joined_by_[scan] = group.members()[settled.best.support.met.front()].scan;
    group.add(scan, settled.best.T_group_scan);
    joined_[scan] = true;
    reasons_[scan].clear();
    links_.insert(links_.end(), settled.links.begin(), settled.links.end());
  }

  /** \return the scan that is not joined, nor refused, with the best place */
  std::size_t
  clearest(const std::vector<std::vector<Place>>& places,
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
  recheck(ScanGroup& group)
  {
    bool is_changed = false;
    const std::vector<PlacedScan> members = group.members();
    for (std::size_t k = 0; k < members.size() && group.members().size() > 2; ++k) {
      const std::size_t scan = members[k].scan;
      auto places = placement_->placesOf(scan, group);
      if (places.empty())
        continue;
      const Settled settled = placement_->settle(scan, places, group, links_);
      if (settled.accepted && areSamePlace(settled.best.T_group_scan,
                                           members[k].T_group_scan,
                                           scans_[scan]->cell())) {
        continue;
      }
      if (k == 0 || isKnown(scan))
        continue; // the frame of the group
      group.remove(scan);
      joined_[scan] = false;
      reasons_[scan] =
          settled.accepted ? "without it, another place is better" : settled.reason;
      is_changed = true;
    }
    return is_changed;
  }

  const ScanList& scans_;
  const JoinOptions& options_;
  std::vector<std::optional<Eigen::Isometry3d>> known_; // by place in scans_, or empty
  std::optional<PlaceHypotheses> hypotheses_;
  std::optional<JointPlacement> placement_;
  std::vector<bool> joined_;
  std::vector<std::string> reasons_;
  std::vector<RankedPair> ranked_;
  std::set<ScanPlaces> placed_; // pairs
  std::set<ScanPlaces> tried_;
  JoinedBy joined_by_;
  std::vector<LinkEvidence> links_; // that hold joined scans
  std::vector<ScanGroup> groups_;
};

/** Takes over a group. \param[in] order places of the scans */
void
take(const ScanGroup& group, const std::vector<std::size_t>& order, JoinedScans& result)
{
  std::vector<std::size_t>& members = result.groups.emplace_back();
  for (const auto& one : group.members()) {
    JoinedScan& scan = result.scans[order[one.scan]];
    const double voxel = group.scan(one.scan).scan().voxel();
    const JointSupport support = group.support(one.scan,
                                               one.T_group_scan,
                                               kMetVoxels * voxel,
                                               kPlaceVoxels * voxel,
                                               kContradictedMatch);
    scan = {result.groups.size() - 1,
            one.T_group_scan,
            support.overlap,
            support.contradiction,
            ""};
    members.push_back(order[one.scan]);
  }
}

/** Those that no group has are alone, in the order of their places. */
void
takeLoose(const Joiner& joiner,
          const std::vector<std::size_t>& order,
          JoinedScans& result)
{
  std::vector<bool> is_loose(order.size(), true);
  for (const auto& group : result.groups)
    for (const std::size_t place : group)
      is_loose[place] = false;
  for (std::size_t k = 0; k < order.size(); ++k)
    if (is_loose[order[k]])
      result.scans[order[k]].reason =
          joiner.reasonOf(k).empty()
              ? "no place where its surfaces meet those of others"
              : joiner.reasonOf(k);
  for (std::size_t place = 0; place < order.size(); ++place)
    if (is_loose[place]) {
      result.scans[place].group = result.groups.size();
      result.groups.push_back({place});
    }
}
} // namespace

void
JoinOptions::validate() const
{
  require(pairs_per_scan > 0, "pairs_per_scan", pairs_per_scan, "> 0");
  require(max_ambiguity >= 0 && max_ambiguity <= 1,
          "max_ambiguity",
          max_ambiguity,
          "in [0, 1]");
}

JoinedScans
joinScans(const std::deque<PlaceableScan>& scans, const JoinOptions& options)
{
  options.validate();
  if (!options.known.empty() && options.known.size() != scans.size())
    throw BadArgument("known = " + std::to_string(options.known.size()) +
                      " poses, but there are " + std::to_string(scans.size()) +
                      " scans");
  JoinedScans result;
  result.scans.resize(scans.size());
  if (scans.empty())
    return result;
  const std::vector<std::size_t> order = contentOrder(scans);
  ScanList list;
  std::vector<std::optional<Eigen::Isometry3d>> known;
  for (const std::size_t place : order) {
    list.push_back(&scans[place]);
    if (!options.known.empty())
      known.push_back(options.known[place]);
  }
  Joiner joiner(list, options, std::move(known));
  joiner.run(result);
  for (const auto& group : joiner.groups())
    if (group.members().size() > 1 || joiner.isKnown(group.members().front().scan))
      take(group, order, result);
  takeLoose(joiner, order, result);
  return result;
}

} // namespace pcl6d
