// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "any_order/joined_runs.h"
#include "matching/sequence_matcher.h"

#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace pcl6d::slam6d {

/** \brief The map for matching: the registered scans at their poses. The result owns the poses. If
 * they differ from the poses of the map, the next use rebuilds the map, and stages need not notify
 * it. */
class Map {
public:
  /** All arguments are kept by reference. */
  Map(const Slam6DOptions& options,
      const Slam6DParameters& parameters,
      const KeptScans& scans,
      Recovery& recovery);

  /** \return how scans are prepared and matched */
  const ScanMatcher&
  matcher() const
  {
    return matcher_->matcher();
  }

  /** \brief Registers a scan with the scans before (SequenceMatcher::match()). */
  void
  match(std::size_t scan, std::vector<ScanResult>& scans);

  /** \brief Adds an already registered scan. */
  void
  takeIn(std::size_t scan, const std::vector<ScanResult>& scans);

  /** \brief Recovers lost scans once more, with all scans. */
  KnownPlaces
  recover(const ProgressCallback& report, Slam6DResult& result);

private:
  /** The state of an added scan. */
  struct Taken {
    bool is_registered = false;
    Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  };

  void
  update(std::size_t count, const std::vector<ScanResult>& scans);
  void
  note(std::size_t count, const std::vector<ScanResult>& scans);

  const Slam6DOptions& options_;
  const Slam6DParameters& parameters_;
  const KeptScans& scans_;
  Recovery& recovery_;
  std::optional<SequenceMatcher>
      matcher_; ///< never empty; its references cannot be assigned
  std::vector<Taken> taken_;
  std::size_t revision_ = 0; ///< of the points
};

} // namespace pcl6d::slam6d
