// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/global_registration/place_by_guesses.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/verification/verified_scan.h>

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::slam6d {

/** \return a number of motions one after the other: motion^count */
PCL6D_EXPORTS Eigen::Isometry3d // shown to its test
repeated(const Eigen::Isometry3d& motion, std::size_t count);

/** \brief The way back for scans that cannot be matched where the odometry expects them
 * (algorithms.md G.3): from where the last motion leads, from around the prediction, and from
 * nothing at all. Points and rays of the scans around decide. */
class Recovery {
public:
  /** A place that was found. */
  struct Found {
    Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
    RecoveredBy by = RecoveredBy::kNone;
  };

  /** Both are kept by reference; scans may grow. */
  Recovery(const Slam6DOptions& options, const std::deque<VerifiedScan>& verified);

  /** \return why the scans around do not hold a scan where it was matched; empty if they do
   * \param[in] scans of the run; those believed are asked
   * \param[in] needs of the place: whether it was expected there */
  std::string
  objection(std::size_t scan,
            const Eigen::Isometry3d& T_world_scan,
            const std::vector<ScanResult>& scans,
            PlaceNeeds needs = PlaceNeeds::kToBeHeld);

  /** \return whether rays call a link between the scans before good: else they are no judges
   * here, or have not shown that they are */
  bool
  raysJudge(std::size_t scan, const std::vector<ScanResult>& scans) const;

  /** \return whether the scans before seem to look through a scan where it was matched, by a
   * look at some of its points: worth an objection() */
  bool
  seemsContradicted(std::size_t scan,
                    const Eigen::Isometry3d& T_world_scan,
                    const std::vector<ScanResult>& scans);

  /** \brief Looks for a lost scan.
   * \param[in] scans of the run, up to this one at least; its predicted pose among them */
  std::optional<Found>
  find(std::size_t scan, const std::vector<ScanResult>& scans);

  /** \brief Looks for the place of a piece: lost scans that were matched among themselves.
   * From the scan that follows it, if that is believed, the odometry leads back to the piece.
   * \param[in] piece its scans, in their order \param[in] own their poses in the piece's frame
   * \param[in] scans of the run
   * \return T_world_piece, where nothing speaks against any of the piece's scans */
  std::optional<Eigen::Isometry3d>
  findBefore(const std::vector<std::size_t>& piece,
             const std::vector<ScanResult>& own,
             const std::vector<ScanResult>& scans);

  /** \return the scan made ready to be placed */
  const PlaceableScan&
  placeable(std::size_t scan);

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
  usualBefore(std::size_t scan, const std::vector<ScanResult>& scans) const;
  std::vector<Eigen::Isometry3d>
  spread(const Eigen::Isometry3d& about, const Eigen::Vector3d& up, double by) const;
  std::optional<Found>
  findEverywhere(std::size_t scan, const std::vector<ScanResult>& scans);

  const Slam6DOptions& options_;
  const std::deque<VerifiedScan>& verified_;
  std::deque<std::optional<PlaceableScan>> placeable_; ///< made when first needed
};

} // namespace pcl6d::slam6d
