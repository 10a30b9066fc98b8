// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "group_ties.h"
#include "joint_placement.h"
#include "place_hypotheses.h"
#include "scan_blocks.h"

#include <pcl6d/global_registration/scan_joiner.h>

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace pcl6d::global_registration {

/** \brief A group, and why it is not part of a larger one. */
struct JoinedGroup {
  ScanGroup scans;
  std::string reason;
};

/** \brief One run of joinScans(); scans in the order of their content. */
class Joiner {
public:
  using Known = std::vector<std::optional<KnownPlace>>;

  /** Scans and options are kept by reference.
   * \param[in] known by place in scans, in place of those of the options
   * \param[in] pairs that are compared, the smaller place first; empty: all */
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
  std::vector<ScanPlaces>
  comparedPairs() const;
  void
  place(const std::vector<RankedPair>& pairs);
  void
  leaveTorn();
  void
  dropSingles();
  void
  judgeAgain();
  void
  growKnown();
  void
  addGrown(const PlaceHypothesis& seed);
  void
  cutLoose(ScanGroup& group);
  std::size_t
  rankOf(const ScanGroup& group) const;
  void
  sortGroups();
  void
  mergeGroups();
  bool
  merge(JoinedGroup& to, JoinedGroup& from);
  std::string
  settleBlock(const ScanGroup& to,
              const ScanGroup& block,
              const BlockPlace& place,
              Eigen::Isometry3d& T_group_block);
  std::string
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
  Known known_; // by place in scans_, or empty
  std::vector<ScanPlaces> pairs_;
  PlaceHypotheses hypotheses_;
  JointPlacement placement_;
  std::vector<bool> joined_;
  std::vector<std::string> reasons_;
  std::vector<RankedPair> ranked_;
  std::set<ScanPlaces> placed_; // pairs
  std::set<ScanPlaces> tried_;
  JoinedBy joined_by_;
  std::vector<LinkEvidence> links_; // that hold joined scans
  std::vector<JoinedGroup> groups_;
};

} // namespace pcl6d::global_registration
