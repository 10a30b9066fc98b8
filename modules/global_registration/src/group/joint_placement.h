// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "group/scan_group.h"
#include "pair/place_hypotheses.h"

#include <pcl6d/global_registration/place_by_guesses.h>
#include <pcl6d/verification/link_evidence.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Number of links of a scan tested one by one: with the scans of most overlap. */
constexpr std::size_t kTestedLinks = 6;

/** \brief A candidate pose of a scan in a group, with its support. */
struct Place {
  Eigen::Isometry3d T_group_scan = Eigen::Isometry3d::Identity();
  double strength = 0; ///< of the hypotheses for the pose
  JointSupport support;
};

/** \brief Result of testing the candidate poses of a scan. */
struct Settled {
  bool accepted = false;
  Place best;
  double ambiguity = 0;            ///< score of the second pose / score of the best
  Rejection rejection;             ///< reason of the rejection
  std::vector<LinkEvidence> links; ///< of the best pose
};

/** \brief Poses of single scans in groups, tested by the whole group. */
class JointPlacement {
public:
  /** Scans and hypotheses are kept by reference; later hypotheses count, too. */
  JointPlacement(const ScanList& scans,
                 const PlaceHypotheses& hypotheses,
                 double max_ambiguity,
                 unsigned int num_threads);

  /** \return poses of a scan by its hypotheses on members, ranked by a quick test, the best
   * first; a member does not test itself */
  std::vector<Place>
  placesOf(std::size_t scan, const ScanGroup& group) const;

  /** \brief Matches the best poses of a scan, and tests each by the whole group.
   * \param[in] places at least one pose, the best first
   * \param[in] links of the map: the usual violations of right poses */
  Settled
  settle(std::size_t scan,
         const std::vector<Place>& places,
         const ScanGroup& group,
         const std::vector<LinkEvidence>& links,
         PlaceNeeds needs = PlaceNeeds::kConnected) const;

  /** \return the reason why members reject the pose of a scan, in words; empty if accepted */
  Rejection
  rejectionOf(std::size_t scan,
              const Eigen::Isometry3d& T_group_scan,
              const ScanGroup& group,
              const std::vector<LinkEvidence>& links,
              PlaceNeeds needs) const;

private:
  bool
  isContradicted(const JointSupport& support, const ScanGroup& group) const;
  void
  decide(std::size_t scan,
         const ScanGroup& group,
         const std::vector<LinkEvidence>& links,
         PlaceNeeds needs,
         Settled& settled) const;
  std::vector<LinkEvidence>
  evidenceOf(std::size_t scan,
             const Eigen::Isometry3d& T_group_scan,
             const std::vector<std::size_t>& met,
             const ScanGroup& group) const;

  const ScanList& scans_;
  const PlaceHypotheses& hypotheses_;
  double max_ambiguity_;
  unsigned int num_threads_;
};

} // namespace pcl6d::global_registration
