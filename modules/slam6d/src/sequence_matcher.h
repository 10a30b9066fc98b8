// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "kept_scans.h"
#include "recovery.h"
#include "scan_matcher.h"

#include <pcl6d/common/progress.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <cstddef>
#include <vector>

namespace pcl6d::slam6d {

/** \return whether lost scans are looked for: where odometry tells how scans follow */
bool
isRecovering(const Slam6DOptions& options);

/** \return the pose to which odometry carries on from the scan before; of the first, its
 * initial pose */
Eigen::Isometry3d
predictedPose(const std::vector<ScanResult>& scans, std::size_t scan);

/** \brief Scans one after the other: matched from where odometry leads, and looked for where
 * that is not believed. */
class SequenceMatcher {
public:
  /** All are kept by reference. */
  SequenceMatcher(const Slam6DOptions& options,
                  const Slam6DParameters& parameters,
                  const KeptScans& scans,
                  Recovery& recovery);

  const ScanMatcher&
  matcher() const
  {
    return matcher_;
  }

  /** \brief Registers a scan behind those before it. The first keeps its pose. */
  void
  match(std::size_t scan, std::vector<ScanResult>& scans);

  /** \brief Takes in a scan as it stands in its result. */
  void
  takeIn(std::size_t scan, const std::vector<ScanResult>& scans);

  /** \brief Looks for all that are lost once more, by all others (RecoveryStage). */
  void
  recover(const ProgressCallback& report, Slam6DResult& result);

private:
  bool
  isDoubtful(const ScanResult& found,
             std::size_t scan,
             const std::vector<ScanResult>& scans);
  bool
  isExpected(const ScanResult& found,
             std::size_t scan,
             const std::vector<ScanResult>& scans) const;
  void
  lookFor(std::size_t scan, std::vector<ScanResult>& scans);

  const Slam6DOptions& options_;
  const KeptScans& scans_;
  Recovery& recovery_;
  ScanMatcher matcher_;
};

} // namespace pcl6d::slam6d
