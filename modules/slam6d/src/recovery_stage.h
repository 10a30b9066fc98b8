// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kept_scans.h"
#include "recovery.h"
#include "scan_matcher.h"

#include <pcl6d/common/progress.h>
#include <pcl6d/global_registration/scan_joiner.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <cstddef>
#include <vector>

namespace pcl6d::slam6d {

/** \brief What could not be matched while the map grew, once all scans are there: lost scans
 * that follow each other are matched among themselves, and such pieces find their place in the
 * map as a whole, by all their scans together. */
class RecoveryStage {
public:
  /** All are kept by reference. \param[in] matcher of the map, which takes in what is found */
  RecoveryStage(const Slam6DOptions& options,
                const KeptScans& scans,
                Recovery& recovery,
                ScanMatcher& matcher);

  /** \brief Changes the poses of lost scans. Those that stay lost keep their places within
   * their piece; the piece lies where the odometry leads.
   * \param[in] report of progress; may throw, which ends it
   * \param[in,out] result not to be used if it ended so */
  void
  run(const ProgressCallback& report, Slam6DResult& result);

private:
  using Piece = std::vector<std::size_t>;

  std::vector<Piece>
  piecesOf(const ProgressCallback& report, const Slam6DResult& result);
  bool
  follow(std::size_t scan, ScanMatcher& matcher, std::vector<ScanResult>& own);
  JoinedScans
  join(const std::vector<Piece>& pieces,
       const ProgressCallback& report,
       const Slam6DResult& result);
  void
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
  layBeside(const Piece& piece, const std::string& why, Slam6DResult& result) const;
  std::vector<std::pair<std::size_t, std::size_t>>
  likelyPairs(const Slam6DResult& result) const;

  const Slam6DOptions& options_;
  const KeptScans& scans_;
  Recovery& recovery_;
  ScanMatcher& matcher_;
  std::vector<ScanResult> own_; ///< of lost scans, in the frames of their pieces
};

} // namespace pcl6d::slam6d
