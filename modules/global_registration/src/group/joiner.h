// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "group/group_ties.h"
#include "group/joint_placement.h"
#include "group/scan_blocks.h"
#include "pair/place_hypotheses.h"

#include <pcl6d/global_registration/scan_joiner.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <vector>

namespace pcl6d::global_registration {

/** \brief A group, and the reason why it is separate from a larger group. */
struct JoinedGroup {
  ScanGroup scans;
  Rejection rejection;
  /** Its scans if it grows from its seed with all scans available, in a frame of its own; none: not
   * known yet */
  std::optional<std::vector<PlacedScan>> alone;
};

/** \brief One run of joinScans(); scans in the order of their content. */
class Joiner {
public:
  using Known = std::vector<std::optional<KnownPlace>>;

  /** Scans and options are kept by reference.
   * \param[in] known by index in scans, in place of JoinOptions::known
   * \param[in] pairs to compare, the smaller index first; empty: every pair */
  Joiner(const ScanList& scans,
         const JoinOptions& options,
         Known known,
         std::vector<ScanPlaces> pairs);

  /** \param[in,out] result gets the numbers of pairs */
  void
  run(JoinedScans& result);

  const std::vector<JoinedGroup>&
  groups() const
  {
    return grown_.groups;
  }
  const Rejection&
  rejectionOf(std::size_t scan) const
  {
    return grown_.rejections[scan];
  }

  bool
  hasKnown() const
  {
    return std::any_of(
        known_.begin(), known_.end(), [](const auto& one) { return one.has_value(); });
  }
  bool
  isKnown(std::size_t scan) const
  {
    return scan < known_.size() && known_[scan].has_value();
  }

private:
  /** Groups, and what is known about their scans. */
  struct Grown {
    std::vector<JoinedGroup> groups;
    std::vector<bool> joined;
    std::vector<Rejection> rejections;
    std::set<ScanPlaces> tried; ///< seeds
    JoinedBy joined_by;
    std::vector<LinkEvidence> links; ///< of joined scans
  };

  std::vector<ScanPlaces>
  comparedPairs() const;
  void
  place(const std::vector<RankedPair>& pairs);
  void
  leaveTorn();
  bool
  isAnotherPlace(std::size_t scan, const JoinedGroup& own, JoinedGroup& other);
  bool
  isLargeEnough(const JoinedGroup& other, const JoinedGroup& own) const;
  void
  dropSingles();
  void
  testAgain();
  void
  growGroups();
  void
  growKnown();
  void
  addLargest(const PlaceHypothesis& seed);
  Grown
  grownAlone(const PlaceHypothesis& seed);
  void
  addGrown(const PlaceHypothesis& seed,
           std::optional<std::vector<PlacedScan>> alone = {});
  void
  cutDisconnected(ScanGroup& group);
  std::size_t
  rankOf(const ScanGroup& group) const;
  void
  sortGroups();
  void
  mergeGroups();
  bool
  merge(JoinedGroup& to, JoinedGroup& from);
  Rejection
  settleBlock(const ScanGroup& to,
              const ScanGroup& block,
              const BlockPlace& place,
              Eigen::Isometry3d& T_group_block);
  Rejection
  contradictionOf(const ScanGroup& block,
                  const Eigen::Isometry3d& T_group_block,
                  const ScanGroup& group) const;
  std::size_t
  grow(ScanGroup& group);
  void
  join(std::size_t scan, const Settled& settled, ScanGroup& group);
  std::size_t
  clearest(const std::vector<std::vector<Place>>& places,
           const std::vector<bool>& is_refused) const;
  bool
  recheck(ScanGroup& group);

  const ScanList& scans_;
  const JoinOptions& options_;
  Known known_; // by index in scans_, or empty
  std::vector<ScanPlaces> pairs_;
  PlaceHypotheses hypotheses_;
  JointPlacement placement_;
  std::vector<RankedPair> ranked_;
  std::set<ScanPlaces> placed_; // pairs
  Grown grown_;
  std::set<ScanPlaces> paid_;     // placed pairs, of a limited number
  std::set<ScanPlaces> left_out_; // pairs beyond the limit
  int num_competitors_ = 0;       // groups grown from all scans by isAnotherPlace()
};

} // namespace pcl6d::global_registration
