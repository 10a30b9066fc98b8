// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "recovery/recovery_budget.h"

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/global_registration/pair_memory.h>
#include <pcl6d/global_registration/place_by_guesses.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/verification/verified_scan.h>

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::slam6d {

/** \return whether the time of failed searches is limited to about the time of matching */
bool
isBounded(const Slam6DOptions& options);

/** Result of rays on the latest links of a map. */
enum class RayTest {
  kUnproven, ///< there are no links yet
  kFailed, ///< none is confirmed: glass, motion during the scans, errors of the scanner
  kConfirming
};

/** A match that was not accepted. */
struct RejectedMatch {
  /** points and rays of surrounding scans do not confirm it */
  bool is_unconfirmed = false;
  bool is_contradicted = false; ///< ... but an inconsistent link rejects it
  bool is_expected = false;     ///< agrees with the odometry
  RayTest rays = RayTest::kUnproven;
};

/** \return whether to search for the scan far from its prediction, too. A bounded recovery does not,
 * if a match agrees with the odometry, no link contradicts it, and rays confirm no other link
 * either: the same rays would test every pose found, and a long search takes longer than all
 * matches of a short run */
PCL6D_EXPORTS bool // exported for its test
isLongSearchUseful(const RejectedMatch& match, RecoveryEffort effort);

/** \brief Recovery of scans without a match at the pose predicted by odometry. Searches by the
 * previous motion, then around the prediction, then without prediction (With a predicted pose, in
 * share/doc/place_recognition.md). Points and rays of the surrounding scans decide. */
class Recovery {
public:
  /** A recovered pose. */
  struct Found {
    Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
    RecoveredBy by = RecoveredBy::kNone;
  };

  /** Both are kept by reference; scans may grow. */
  Recovery(const Slam6DOptions& options, const std::deque<VerifiedScan>& verified);

  /** \return why the surrounding scans do not confirm the pose of a match; empty: confirmed
   * \param[in] scans of the run; the registered ones are observers
   * \param[in] needs the required confirmation, depending on whether the pose was expected */
  Rejection
  rejectionOf(std::size_t scan,
              const Eigen::Isometry3d& T_world_scan,
              const std::vector<ScanResult>& scans,
              PlaceNeeds needs = PlaceNeeds::kConfirmed);

  /** \return whether rays confirm a link between previous scans */
  RayTest
  testRays(std::size_t scan, const std::vector<ScanResult>& scans);

  /** \return whether a quick check with few points finds that rays of previous scans pass through
   * the matched scan: a reason for the full test */
  bool
  seemsContradicted(std::size_t scan,
                    const Eigen::Isometry3d& T_world_scan,
                    const std::vector<ScanResult>& scans);

  /** \return why no pose of the scan could be confirmed: it has too few surfaces, or rays contradict
   * its own points; empty: a search is worth while */
  Rejection
  whyUnconfirmable(std::size_t scan) const;

  /** \brief Searches for a lost scan only at the poses predicted by odometry and the previous
   * motion, in about the time of a match. Parameters and result as in find(). */
  std::optional<Found>
  findByMotion(std::size_t scan, const std::vector<ScanResult>& scans);

  /** \brief Searches for a lost scan at growing distances from its prediction.
   * \param[in] scans of the run, up to this scan at least, with its predicted pose */
  std::optional<Found>
  find(std::size_t scan, const std::vector<ScanResult>& scans);

  /** \brief Searches for the pose of a piece: lost scans matched with each other. If the scan after
   * the piece is registered, the odometry leads back from there.
   * \param[in] piece its scans, in order \param[in] own poses of the scans in the piece's frame
   * \param[in] scans of the run
   * \return T_world_piece if no scan of the piece is contradicted */
  std::optional<Eigen::Isometry3d>
  findBefore(const std::vector<std::size_t>& piece,
             const std::vector<ScanResult>& own,
             const std::vector<ScanResult>& scans);

  /** \return the scan, prepared for place recognition */
  const PlaceableScan&
  placeable(std::size_t scan);

  /** \return what a bounded run may still spend */
  RecoveryBudget&
  budget()
  {
    return budget_;
  }

  /** \return the results of all searches of the run among pairs of scans */
  PairMemory&
  pairs()
  {
    return pairs_;
  }

private:
  std::vector<std::size_t>
  around(std::size_t scan,
         const Eigen::Vector3d& position,
         const std::vector<ScanResult>& scans,
         std::size_t latest,
         std::size_t nearest) const;
  std::vector<KnownScan>
  knownAround(std::size_t scan,
              const Eigen::Vector3d& position,
              const std::vector<ScanResult>& scans);
  std::vector<LinkEvidence>
  usualBefore(std::size_t scan, const std::vector<ScanResult>& scans);
  GuessOptions
  guessOptions(std::size_t scan,
               const std::vector<ScanResult>& scans,
               double deviation);
  std::optional<Found>
  findEverywhere(std::size_t scan, const std::vector<ScanResult>& scans);

  const Slam6DOptions& options_;
  const std::deque<VerifiedScan>& verified_;
  std::deque<std::optional<PlaceableScan>> placeable_; ///< made when first needed
  std::deque<std::optional<LinkEvidence>>
      usual_; ///< with the scan before, at the last pose
  PairMemory pairs_;
  RecoveryBudget budget_;
};

} // namespace pcl6d::slam6d
