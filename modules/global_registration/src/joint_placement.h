// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "place_hypotheses.h"
#include "scan_group.h"

#include <pcl6d/global_registration/place_by_guesses.h>
#include <pcl6d/verification/link_evidence.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Links of a scan that are judged one by one: those with scans that it meets most. */
constexpr std::size_t kJudgedLinks = 6;

/** \brief A place of a scan in a group, and what speaks for it. */
struct Place {
  Eigen::Isometry3d T_group_scan = Eigen::Isometry3d::Identity();
  double strength = 0; ///< of the hypotheses that say so
  JointSupport support;
};

/** \brief What came of judging the places of a scan. */
struct Settled {
  bool accepted = false;
  Place best;
  double ambiguity = 0;            ///< score of the second place / that of the best
  std::string reason;              ///< why it is not accepted
  std::vector<LinkEvidence> links; ///< of the best place
};

/** \brief Places of single scans in groups, judged by all members together. */
class JointPlacement {
public:
  /** All are kept by reference, also the hypotheses that are yet to come. */
  JointPlacement(const ScanList& scans,
                 const PlaceHypotheses& hypotheses,
                 double max_ambiguity,
                 unsigned int num_threads);

  /** \return places of a scan by its hypotheses on members, as a look judges them, the best
   * first; a member is not asked about itself */
  std::vector<Place>
  placesOf(std::size_t scan, const ScanGroup& group) const;

  /** \brief Matches the best places of a scan, and judges them by all members.
   * \param[in] places at least one, the best first
   * \param[in] links of the map, which tell what right ones contradict */
  Settled
  settle(std::size_t scan,
         const std::vector<Place>& places,
         const ScanGroup& group,
         const std::vector<LinkEvidence>& links,
         PlaceNeeds needs = PlaceNeeds::kToBeTied) const;

  /** \return what members have against the place of a scan, in words; nothing if it has what
   * it needs */
  std::string
  objectionTo(std::size_t scan,
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
