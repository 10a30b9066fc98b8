// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "any_order/joined_runs.h"
#include "matching/kept_scans.h"
#include "matching/scan_matcher.h"
#include "recovery/recovery.h"

#include <pcl6d/common/progress.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <cstddef>
#include <vector>

namespace pcl6d::slam6d {

/** \return whether lost scans are searched for, which requires an order of the scans by odometry */
bool
isRecovering(const Slam6DOptions& options);

/** \return whether initial poses were measured: without, all are equal */
bool
hasGivenPoses(const std::vector<ScanResult>& scans);

/** \return the pose predicted from the previous scan by odometry; for the first scan, its initial
 * pose */
Eigen::Isometry3d
predictedPose(const std::vector<ScanResult>& scans, std::size_t scan);

/** \brief Registers scans in sequence: each is matched from its predicted pose, and recovered if
 * the match is rejected. */
class SequenceMatcher {
public:
  /** All arguments are kept by reference. */
  SequenceMatcher(const Slam6DOptions& options,
                  const Slam6DParameters& parameters,
                  const KeptScans& scans,
                  Recovery& recovery);

  const ScanMatcher&
  matcher() const
  {
    return matcher_;
  }

  /** \brief Matches a scan with the scans before. The first scan is fixed. */
  void
  match(std::size_t scan, std::vector<ScanResult>& scans);

  /** \brief Adds a scan with the pose of its result. */
  void
  takeIn(std::size_t scan, const std::vector<ScanResult>& scans);

  /** \brief Recovers lost scans once more, with all scans (RecoveryStage). */
  KnownPlaces
  recover(const ProgressCallback& report, Slam6DResult& result);

private:
  void
  matchOrRecover(std::size_t scan, std::vector<ScanResult>& scans);
  bool
  isFixedByStep(std::size_t scan, const std::vector<ScanResult>& scans) const;
  bool
  isWhereTracked(const ScanResult& found,
                 std::size_t scan,
                 const std::vector<ScanResult>& scans) const;
  bool
  isDoubtful(const ScanResult& found,
             std::size_t scan,
             const std::vector<ScanResult>& scans);
  PlaceNeeds
  neededBy(const ScanResult& found,
           std::size_t scan,
           const std::vector<ScanResult>& scans) const;
  bool
  isExpected(const ScanResult& found,
             std::size_t scan,
             const std::vector<ScanResult>& scans) const;
  void
  lookFor(std::size_t scan, bool is_long, std::vector<ScanResult>& scans);

  const Slam6DOptions& options_;
  const KeptScans& scans_;
  Recovery& recovery_;
  ScanMatcher matcher_;
};

} // namespace pcl6d::slam6d
