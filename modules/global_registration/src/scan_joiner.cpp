// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "place_hypotheses.h"
#include "scan_blocks.h"
#include "scan_group.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/require.h>
#include <pcl6d/global_registration/scan_joiner.h>
#include <pcl6d/verification/link_evidence.h>
#include <pcl6d/verification/ties.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace pcl6d {
using namespace global_registration;

namespace {
/** So many places of a scan are looked at, and so many of these matched. */
constexpr std::size_t kPlacesLookedAt = 8, kSettled = 3;

/** Half of the points are enough for a look. */
constexpr std::size_t kEvery = 2;

/** A link with more than this is another place by its rays. */
constexpr double kElsewhere = 0.5;

/** Links of a joined scan that are judged one by one: those that it meets most. */
constexpr std::size_t kJudgedLinks = 6;

/** So often scans are judged again without themselves. */
constexpr int kRechecks = 3;

/** A place of a scan in a group, and what speaks for it. */
struct Place {
  Eigen::Isometry3d T_group_scan = Eigen::Isometry3d::Identity();
  double strength = 0;
  JointSupport support;
};

/** What came of judging the places of a scan. */
struct Settled {
  bool accepted = false;
  Place best;
  double ambiguity = 0;
  std::string reason; // why not
  std::vector<LinkEvidence> links;
};

std::uint64_t
fingerprint(const PlaceableScan& scan)
{
  std::uint64_t hash = 0xcbf29ce484222325; // FNV-1a
  for (const auto& p : scan.matched().points)
    for (int k = 0; k < 3; ++k) {
      std::uint32_t bits;
      std::memcpy(&bits, &p[k], sizeof bits);
      hash = (hash ^ bits) * 0x100000001b3;
    }
  return hash;
}

/** One run of joinScans(); scans in the order of their content. */
class Joiner {
public:
  Joiner(const ScanList& scans, const JoinOptions& options)
  : scans_(scans), options_(options), joined_(scans.size()), reasons_(scans.size())
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
    place(bestOfEach(ranked_, scans_.size(), options_.pairs_per_scan));
    while (const PlaceHypothesis* seed = nextSeed())
      addGrown(*seed);
    mergeGroups();
    judgeAgain();
    place(furtherPairs());
    judgeAgain();
    mergeGroups();
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
  const Settled&
  settledOf(std::size_t scan) const
  {
    return settled_.at(scan);
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

  /** Of each scan outside the largest group the best pairs with scans of it that were not
   * placed, as far as there may be more. */
  std::vector<RankedPair>
  furtherPairs() const
  {
    if (groups_.empty())
      return {};
    std::vector<RankedPair> further;
    for (const auto& one : ranked_) {
      const auto& [first, second] = one.scans;
      const bool is_across = groups_[0].placeOf(first).has_value() !=
                             groups_[0].placeOf(second).has_value();
      if (is_across && placed_.count(one.scans) == 0)
        further.push_back(one);
    }
    std::stable_sort(further.begin(), further.end(), [](const auto& a, const auto& b) {
      return a.score > b.score;
    });
    const std::size_t most = options_.pairs_per_scan * scans_.size();
    std::map<std::size_t, std::size_t> taken; // of scans outside
    std::vector<RankedPair> best;
    for (const auto& one : further) {
      const std::size_t outside =
          groups_[0].placeOf(one.scans.first) ? one.scans.second : one.scans.first;
      if (placed_.size() + best.size() < most && one.score > 0 &&
          taken[outside]++ < options_.pairs_per_scan)
        best.push_back(one);
    }
    return best;
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

  /** The strongest pair whose scans are in no group. */
  const PlaceHypothesis*
  nextSeed() const
  {
    const PlaceHypothesis* best = nullptr;
    for (const auto& one : hypotheses_->all())
      if (one.can_begin && !joined_[one.first] && !joined_[one.second] &&
          (!best || one.strength > best->strength) &&
          !tried_.count({one.first, one.second}))
        best = &one;
    return best;
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
    splitOff(group);
    groups_.push_back(group);
  }

  /** Members in an order in which all that was joined by way of a scan follows it, as
   * tiesOf() looks at parts of what follows each other. */
  std::vector<std::size_t>
  asTree(const ScanGroup& group) const
  {
    std::map<std::size_t, std::vector<std::size_t>> joined; // places of members
    for (std::size_t k = 1; k < group.members().size(); ++k) {
      const auto by = joined_by_.find(group.members()[k].scan);
      const auto parent = std::find_if(
          group.members().begin(), group.members().end(), [&](const PlacedScan& one) {
            return by != joined_by_.end() && one.scan == by->second;
          });
      joined[parent == group.members().end()
                 ? 0
                 : static_cast<std::size_t>(parent - group.members().begin())]
          .push_back(k);
    }
    std::vector<std::size_t> order, open = {0};
    while (!open.empty()) {
      const std::size_t k = open.back();
      open.pop_back();
      order.push_back(k);
      open.insert(open.end(), joined[k].rbegin(), joined[k].rend());
    }
    return order;
  }

  /** What each member and those that it meets most say of each other.
   * \param[in] order of the members, by whose places links name their scans */
  std::vector<LinkCheck>
  linksOf(const ScanGroup& group,
          const std::vector<std::size_t>& order,
          double& background) const
  {
    const auto& members = group.members();
    std::vector<std::vector<std::size_t>> met(members.size());
    parallelFor(members.size(), options_.num_threads, [&](std::size_t k) {
      const double voxel = scans_[members[k].scan]->scan().voxel();
      met[k] = group
                   .support(members[k].scan,
                            members[k].T_group_scan,
                            kMetVoxels * voxel,
                            kPlaceVoxels * voxel,
                            kContradictedMatch,
                            kEvery)
                   .met;
    });
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t k = 0; k < members.size(); ++k)
      for (std::size_t i = 0; i < std::min(met[k].size(), kJudgedLinks); ++i)
        pairs.insert(std::minmax(k, met[k][i]));
    const std::vector<std::pair<std::size_t, std::size_t>> list(pairs.begin(),
                                                                pairs.end());
    std::vector<LinkEvidence> evidence(list.size());
    parallelFor(list.size(), options_.num_threads, [&](std::size_t i) {
      const PlacedScan& a = members[list[i].first];
      const PlacedScan& b = members[list[i].second];
      evidence[i] = linkEvidence(scans_[a.scan]->scan(),
                                 scans_[b.scan]->scan(),
                                 a.T_group_scan.inverse() * b.T_group_scan);
    });
    background = contradictionBackground(evidence);
    std::vector<std::size_t> place(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      place[order[i]] = i;
    std::vector<LinkCheck> links;
    for (std::size_t i = 0; i < list.size(); ++i)
      links.push_back(linkCheck(place[list[i].first],
                                place[list[i].second],
                                evidence[i],
                                judgeLink(evidence[i], background)));
    return links;
  }

  /** Members that links do not tie to the others leave the group.
   * \return their number */
  std::size_t
  cutLoose(ScanGroup& group)
  {
    if (group.members().size() < 3)
      return 0;
    const auto order = asTree(group);
    double background = 0;
    const auto links = linksOf(group, order, background);
    const auto ties = verification::tiesOf(order.size(), links, background);
    const std::vector<PlacedScan> members = group.members();
    std::size_t count = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
      if (ties.tied[i])
        continue;
      const std::size_t scan = members[order[i]].scan;
      group.remove(scan);
      joined_[scan] = false;
      reasons_[scan] = ties.cut_from[i].empty() ? "no scan holds it where it fits best"
                                                : ties.cut_from[i];
      ++count;
    }
    return count;
  }

  /** Parts of a group that fit it elsewhere as well become groups of their own. */
  void
  splitOff(ScanGroup& group)
  {
    for (std::size_t k = group.members().size(); k-- > 1;) {
      if (k >= group.members().size())
        continue;
      ScanGroup block(scans_), rest(scans_);
      divide(group, group.members()[k].scan, block, rest);
      if (block.members().size() < 2 || rest.members().size() < 2 ||
          !fitsElsewhere(rest, block))
        continue;
      groups_.push_back(block);
      group = rest;
    }
  }

  /** Cuts a group into what was joined by way of a scan, with it, and the rest. */
  void
  divide(const ScanGroup& group,
         std::size_t scan,
         ScanGroup& block,
         ScanGroup& rest) const
  {
    std::set<std::size_t> below = {scan};
    for (const auto& one : group.members()) { // in the order in which they were joined
      const auto by = joined_by_.find(one.scan);
      if (by != joined_by_.end() && below.count(by->second) > 0)
        below.insert(one.scan);
      (below.count(one.scan) > 0 ? block : rest).add(one.scan, one.T_group_scan);
    }
  }

  bool
  fitsElsewhere(const ScanGroup& rest, const ScanGroup& block) const
  {
    BlockPlace here;
    judgeBlock(rest, block, here);
    for (const auto& other :
         placesOfBlock(rest, block, *hypotheses_, options_.num_threads))
      if (other.score > options_.max_ambiguity * here.score &&
          !areSameBlockPlaces(block, other.T_group_block, here.T_group_block))
        return true;
    return false;
  }

  /** Joins groups that have one place on each other. */
  void
  mergeGroups()
  {
    std::stable_sort(groups_.begin(), groups_.end(), [](const auto& a, const auto& b) {
      return a.members().size() > b.members().size();
    });
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
    auto places = placesOfBlock(to, from, *hypotheses_, options_.num_threads);
    if (places.empty() || places[0].score <= 0)
      return false;
    for (std::size_t k = 1; k < places.size(); ++k)
      if (places[k].score > options_.max_ambiguity * places[0].score &&
          !areSameBlockPlaces(from, places[k].T_group_block, places[0].T_group_block))
        return false;
    const PlacedScan& fixing = from.members()[places[0].fixing];
    const std::size_t scan = fixing.scan;
    Place at;
    at.T_group_scan = places[0].T_group_block * fixing.T_group_scan;
    at.support = places[0].support;
    const Settled settled = settle(scan, {at}, to);
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
        places[wanted[k]] = placesOf(wanted[k], group);
      });
      for (const std::size_t u : wanted)
        is_known[u] = true;
      const std::size_t next = clearest(places, is_refused);
      if (next == scans_.size())
        return group.members().size() - before;
      Settled settled = settle(next, places[next], group);
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
    settled_[scan] = settled;
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

  /** Places of a scan by its hypotheses on members, as a look judges them, the best first. */
  std::vector<Place>
  placesOf(std::size_t scan, const ScanGroup& group) const
  {
    std::vector<Place> places;
    for (const std::size_t h : hypotheses_->of(scan)) {
      const PlaceHypothesis& one = hypotheses_->all()[h];
      const bool is_second = one.second == scan;
      const auto fixed = group.placeOf(is_second ? one.first : one.second);
      if (!fixed)
        continue;
      const Eigen::Isometry3d T =
          *fixed * (is_second ? one.T_first_second : one.T_first_second.inverse());
      const auto same = std::find_if(places.begin(), places.end(), [&](const Place& p) {
        return areSamePlace(p.T_group_scan, T, scans_[scan]->cell());
      });
      if (same == places.end())
        places.push_back({T, one.strength, {}});
      else
        same->strength += one.strength;
    }
    std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
      return a.strength > b.strength;
    });
    places.resize(std::min(places.size(), kPlacesLookedAt));
    const double cell = scans_[scan]->cell();
    for (Place& one : places)
      one.support = group.support(
          scan, one.T_group_scan, cell, 0.5 * cell, kContradictedStart, kEvery);
    sortByScore(places);
    return places;
  }

  static void
  sortByScore(std::vector<Place>& places)
  {
    std::stable_sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
      return a.support.score > b.support.score;
    });
  }

  /** Matches the best places of a scan, and judges them by all members. */
  Settled
  settle(std::size_t scan,
         const std::vector<Place>& places,
         const ScanGroup& group) const
  {
    std::vector<Place> best(places.begin(),
                            places.begin() + static_cast<std::ptrdiff_t>(
                                                 std::min(places.size(), kSettled)));
    const double voxel = scans_[scan]->scan().voxel();
    parallelFor(best.size(), options_.num_threads, [&](std::size_t k) {
      Place& one = best[k];
      one.T_group_scan = group.matched(
          scan, one.T_group_scan, one.support.met, 2 * scans_[scan]->cell());
      one.support = group.support(scan,
                                  one.T_group_scan,
                                  kMetVoxels * voxel,
                                  kPlaceVoxels * voxel,
                                  kContradictedMatch);
    });
    sortByScore(best);
    Settled settled;
    settled.best = best.front();
    for (std::size_t k = 1; k < best.size(); ++k)
      if (!areSamePlace(
              best[0].T_group_scan, best[k].T_group_scan, scans_[scan]->cell())) {
        settled.ambiguity = best[k].support.score / best[0].support.score;
        break;
      }
    decide(scan, group, settled);
    return settled;
  }

  void
  decide(std::size_t scan, const ScanGroup& group, Settled& settled) const
  {
    const JointSupport& support = settled.best.support;
    if (support.overlap < kLeastOverlap)
      settled.reason = "too few of its surfaces meet those of others";
    else if (settled.ambiguity > options_.max_ambiguity)
      settled.reason = "another place is nearly as good";
    else
      settled.reason = objection(scan, group, settled);
    settled.accepted = settled.reason.empty();
  }

  /** What members have against a place, one by one. */
  std::string
  objection(std::size_t scan, const ScanGroup& group, Settled& settled) const
  {
    const auto& met = settled.best.support.met;
    settled.links.resize(std::min(met.size(), kJudgedLinks));
    parallelFor(settled.links.size(), options_.num_threads, [&](std::size_t k) {
      const PlacedScan& member = group.members()[met[k]];
      settled.links[k] =
          linkEvidence(scans_[member.scan]->scan(),
                       scans_[scan]->scan(),
                       member.T_group_scan.inverse() * settled.best.T_group_scan);
    });
    const double background = contradictionBackground(links_);
    bool is_held = false;
    for (const auto& link : settled.links) {
      const LinkOpinion opinion = judgeLink(link, background);
      if (opinion.trust == LinkTrust::kWrong && opinion.elsewhere > kElsewhere)
        return "a scan speaks against the best place: " + opinion.reason;
      is_held = is_held || opinion.trust == LinkTrust::kGood ||
                opinion.trust == LinkTrust::kUnverified;
    }
    return is_held ? "" : "no scan holds it where it fits best";
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
      auto places = placesOf(scan, group);
      if (places.empty())
        continue;
      const Settled settled = settle(scan, places, group);
      if (settled.accepted && areSamePlace(settled.best.T_group_scan,
                                           members[k].T_group_scan,
                                           scans_[scan]->cell())) {
        settled_[scan] = settled;
        continue;
      }
      if (k == 0)
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
  std::optional<PlaceHypotheses> hypotheses_;
  std::vector<bool> joined_;
  std::vector<std::string> reasons_;
  std::map<std::size_t, Settled> settled_;
  std::vector<RankedPair> ranked_;
  std::set<ScanPlaces> placed_; // pairs
  std::set<ScanPlaces> tried_;
  std::map<std::size_t, std::size_t> joined_by_; // scan to the one that it met most
  std::vector<LinkEvidence> links_;              // that hold joined scans
  std::vector<ScanGroup> groups_;
};
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
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t i = 0; i < scans.size(); ++i)
    order.emplace_back(fingerprint(scans[i]), i);
  std::sort(order.begin(), order.end());
  ScanList list;
  for (const auto& one : order)
    list.push_back(&scans[one.second]);
  JoinedScans result;
  result.scans.resize(scans.size());
  if (scans.empty())
    return result;
  Joiner joiner(list, options);
  joiner.run(result);
  std::vector<ScanGroup> groups = joiner.groups();
  std::stable_sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) {
    return a.members().size() > b.members().size();
  });
  std::vector<bool> is_joined(scans.size(), false);
  for (const auto& group : groups) {
    if (group.members().size() < 2)
      continue;
    std::vector<std::size_t> members;
    for (const auto& one : group.members()) {
      const std::size_t place = order[one.scan].second;
      is_joined[place] = true;
      members.push_back(place);
      result.scans[place].group = result.groups.size();
      result.scans[place].T_group_scan = one.T_group_scan;
    }
    result.groups.push_back(members);
  }
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t place = order[k].second;
    if (is_joined[place])
      continue;
    result.scans[place].reason =
        joiner.reasonOf(k).empty() ? "no place where its surfaces meet those of others"
                                   : joiner.reasonOf(k);
  }
  for (std::size_t place = 0; place < scans.size(); ++place)
    if (!is_joined[place]) {
      result.scans[place].group = result.groups.size();
      result.groups.push_back({place});
    }
  return result;
}

} // namespace pcl6d
