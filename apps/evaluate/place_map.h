// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/place_report.h"

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

/** \brief The scans of a run that have a sure place there, ready to be searched for a scan. */
class PlaceMap {
public:
  /** Reads the run, but for copies of the scan.
   * \param[in] scan as it was read \param[in] show told of "reading"; may throw
   * \throws IoFailed the folder holds no finished run, a file is not as it was written, no
   * scan has a place, or the units differ \throws ComputeFailed too few points */
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
  /** \return the one that is looked for */
  const PlaceableScan&
  scan() const
  {
    return placeable_.back();
  }
  /** \return what the run tells of a scan */
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
  /** \return the scan of the run that holds the very same points; else empty */
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
  std::deque<PlaceableScan> placeable_; ///< those of the map, and the scan
};

} // namespace pcl6d::app
