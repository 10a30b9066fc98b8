// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "localize/localize_settings.h"

#include <pcl6d/common/progress.h>
#include <pcl6d/global_registration/map_localiser.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/verification/prepared_scans.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief The scans of a finished run, ready for the search of further scans. */
class KnownMap {
public:
  /** Reads the run. \param[in] show called during "reading"; may throw
   * \throws IoFailed the folder holds no finished run, a file was changed, or no scan has a
   * pose \throws ComputeFailed a scan has too few points */
  KnownMap(const LocalizeSettings& settings, const ProgressCallback& show);

  /** \return the scans with poses relative to worldOffset() */
  std::vector<KnownScan>
  scans() const;

  /** \brief Prepares a further scan in the same way as the scans of the map.
   * \throws ComputeFailed the scan has too few points within the range gate */
  PreparedScans
  prepare(const Points& points, const std::string& name) const;

  /** \return indices in scans() of scans with exactly the same points */
  std::set<std::size_t>
  copiesOf(const Points& points) const;

  /** \return [m] */
  const Eigen::Vector3d&
  worldOffset() const
  {
    return run_.summary().world_offset;
  }

private:
  double
  lengthOf(const char* name) const;

  const RunFolder run_;
  std::vector<std::size_t> places_;         ///< of the scans in the summary
  std::vector<std::uint64_t> fingerprints_; ///< of their points
  ScanParameters parameters_;
  std::optional<PreparedScans> prepared_;
  std::deque<PlaceableScan> placeable_;
};

} // namespace pcl6d::app
