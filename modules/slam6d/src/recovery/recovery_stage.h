// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "any_order/joined_runs.h"
#include "matching/kept_scans.h"
#include "matching/scan_matcher.h"
#include "recovery/recovery.h"

#include <pcl6d/common/progress.h>
#include <pcl6d/global_registration/scan_joiner.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <cstddef>
#include <vector>

namespace pcl6d::slam6d {

/** \brief Recovery of lost scans after all scans were added. Consecutive lost scans are matched
 * with each other; each such piece is then registered with the map as a whole, by all its scans
 * together. */
class RecoveryStage {
public:
  /** All arguments are kept by reference. \param[in] matcher of the map, gets the recovered
   * scans */
  RecoveryStage(const Slam6DOptions& options,
                const KeptScans& scans,
                Recovery& recovery,
                ScanMatcher& matcher);

  /** \brief Changes the poses of lost scans. Scans that stay lost follow the odometry.
   * \param[in] report of progress; may throw to end the stage
   * \param[in,out] result not to be used after report threw
   * \return poses of scans that stay lost in pieces of several scans, matched with each other */
  KnownPlaces
  run(const ProgressCallback& report, Slam6DResult& result);

private:
  using Piece = std::vector<std::size_t>;

  std::vector<Piece>
  piecesOf(const ProgressCallback& report, const Slam6DResult& result);
  JoinedScans
  join(const std::vector<Piece>& pieces,
       const ProgressCallback& report,
       const Slam6DResult& result);
  Rejection
  whyInVain(const Piece& piece) const;
  KnownPlaces
  take(const JoinedScans& joined,
       const std::vector<Piece>& pieces,
       Slam6DResult& result);
  void
  takePlace(std::size_t scan,
            const Eigen::Isometry3d& T_world_scan,
            RecoveredBy by,
            Slam6DResult& result);
  void
  placeBackwards(std::vector<Piece>& pieces, Slam6DResult& result);
  void
  layBeside(const Piece& piece, const Rejection& why, Slam6DResult& result) const;
  std::vector<std::size_t>
  askedOf(const std::vector<Piece>& pieces) const;
  std::vector<std::pair<std::size_t, std::size_t>>
  likelyPairs(const std::vector<std::size_t>& asked, const Slam6DResult& result) const;

  const Slam6DOptions& options_;
  const KeptScans& scans_;
  Recovery& recovery_;
  ScanMatcher& matcher_;
  std::vector<ScanResult> own_; ///< of lost scans, in the frames of their pieces
};

} // namespace pcl6d::slam6d
