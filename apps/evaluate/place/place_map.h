// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/place/place_report.h"

#include <pcl6d/common/progress.h>
#include <pcl6d/global_registration/placeable_scan.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/verification/prepared_scans.h>

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The scans of a run with reliable poses, prepared for place recognition of a scan. */
class PlaceMap {
public:
  /** Reads the run, without copies of the scan.
   * \param[in] scan as read \param[in] show progress callback of "reading"; may throw
   * \throws IoFailed the folder contains no finished run, a file has changed since the
   * run, no scan has a pose, or the units differ \throws ComputeFailed too few points */
  PlaceMap(const PlaceSettings& settings,
           const NearScan& scan,
           const ProgressCallback& show);

  /** \return the number of scans of the map */
  std::size_t
  size() const
  {
    return places_.size();
  }
  const PlaceableScan&
  operator[](std::size_t i) const
  {
    return placeable_[i];
  }
  /** \return the scan to find */
  const PlaceableScan&
  scan() const
  {
    return placeable_.back();
  }
  /** \return the run's results for a scan */
  const ScanResult&
  result(std::size_t i) const
  {
    return run_.summary().scans[places_[i]];
  }
  /** \return its pose relative to the world offset */
  Eigen::Isometry3d
  pose(std::size_t i) const;

  const RunResult&
  summary() const
  {
    return run_.summary();
  }
  /** \return [m] */
  double
  voxel() const
  {
    return prepared_->parameters().voxel.value;
  }
  /** \return the scan of the run with identical points; else empty */
  const std::string&
  sameAs() const
  {
    return same_as_;
  }

private:
  std::vector<Points>
  read(const PlaceSettings& settings,
       const NearScan& scan,
       const ProgressCallback& show);
  void
  prepare(const PlaceSettings& settings,
          const NearScan& scan,
          const std::vector<Points>& map);
  double
  lengthOf(const char* name) const;

  const RunFolder run_;
  std::vector<std::size_t> places_; ///< in the summary
  std::string same_as_;
  std::optional<PreparedScans> prepared_;
  std::deque<PlaceableScan> placeable_; ///< scans of the map, and the scan to find
};

} // namespace pcl6d::app
