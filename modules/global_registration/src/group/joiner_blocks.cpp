// SPDX-License-Identifier: BSD-3-Clause
// Groups placed on other groups.
#include "group/joiner.h"

#include <algorithm>

namespace pcl6d::global_registration {

namespace {
/** Number of scans of a block, evenly chosen, tested individually at the new pose: a large
 * block then takes no longer than a few scans. */
constexpr std::size_t kAskedOfBlock = 12;
} // namespace

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
      groups_.begin(), groups_.end(), [this](const auto& a, const auto& b) {
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
  for (std::size_t to = 0; to < groups_.size(); ++to)
    for (std::size_t from = to + 1; from < groups_.size();)
      if (merge(groups_[to], groups_[from])) {
        groups_.erase(groups_.begin() + static_cast<std::ptrdiff_t>(from));
        from = to + 1; // further groups may have a pose relative to the union
      }
      else
        ++from;
}

bool
Joiner::merge(JoinedGroup& to, JoinedGroup& from)
{
  from.rejection = {};
  const auto places =
      placesOfBlock(to.scans, from.scans, hypotheses_, options_.num_threads);
  if (places.empty() || places[0].score <= 0) {
    from.rejection = RejectReason::kNoSurfacesMeet;
    return false;
  }
  std::vector<LinkEvidence> links;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  from.rejection = settleBlock(to.scans, from.scans, places[0], T, links);
  for (std::size_t k = 1; k < places.size() && !from.rejection; ++k)
    if (isRival(to.scans, from.scans, places[0], places[k]))
      from.rejection = {RejectReason::kSecondPose,
                        places[k].score / places[0].score,
                        options_.max_ambiguity};
  if (from.rejection)
    return false;
  links_.insert(links_.end(), links.begin(), links.end());
  for (const auto& one : from.scans.members())
    to.scans.add(one.scan, T * one.T_group_scan);
  return true;
}

/** \return whether another place of a block fits nearly as well as the best, and is not
 * contradicted after matching */
bool
Joiner::isRival(const ScanGroup& to,
                const ScanGroup& block,
                const BlockPlace& best,
                const BlockPlace& other) const
{
  if (other.score <= options_.max_ambiguity * best.score ||
      areSameBlockPlaces(block, other.T_group_block, best.T_group_block))
    return false;
  std::vector<LinkEvidence> links;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  return !settleBlock(to, block, other, T, links);
}

/** Matches the scan of a block with the largest overlap, and tests several more of its scans.
 * \return the contradiction, in words; empty if accepted */
Rejection
Joiner::settleBlock(const ScanGroup& to,
                    const ScanGroup& block,
                    const BlockPlace& place,
                    Eigen::Isometry3d& T_group_block,
                    std::vector<LinkEvidence>& links) const
{
  const PlacedScan& fixing = block.members()[place.fixing];
  Place at;
  at.T_group_scan = place.T_group_block * fixing.T_group_scan;
  at.support = place.support;
  const Settled settled = placement_.settle(fixing.scan, {at}, to, links_);
  if (!settled.accepted)
    return settled.rejection;
  T_group_block = settled.best.T_group_scan * fixing.T_group_scan.inverse();
  if (Rejection contradiction = contradictionOf(block, T_group_block, to))
    return contradiction;
  links = settled.links;
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
                                           links_,
                                           PlaceNeeds::kNoContradiction);
  }
  return contradiction;
}

} // namespace pcl6d::global_registration
