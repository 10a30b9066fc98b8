// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/changes/changes_settings.h"

#include <pcl6d/common/progress.h>
#include <pcl6d/moving_objects/compared_run.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/verification/prepared_scans.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl6d::app {

/** \brief Two runs to compare: their scans with reliable poses, prepared. */
class ComparedRuns {
public:
  /** \param[in] show progress callback of "reading"; may throw
   * \throws IoFailed a folder contains no finished run, a file has changed since the
   * run, no scan has a pose, or the units differ \throws ComputeFailed too few points */
  ComparedRuns(const ChangesSettings& settings, const ProgressCallback& show);

  /** \return the number of scans of a run; 0: A, 1: B */
  std::size_t
  size(std::size_t run) const
  {
    return places_[run].size();
  }
  const VerifiedScan&
  scan(std::size_t run, std::size_t i) const
  {
    return prepared_->scans()[(run == 0 ? 0 : size(0)) + i];
  }
  /** \return name of the run and file name of the scan, for messages */
  std::string
  name(std::size_t run, std::size_t i) const;

  /** \return the scans of a run with their poses relative to the world offset of A */
  ComparedRun
  compared(std::size_t run) const;

  /** \return pairs of a scan of A and a scan of B with identical points; may be empty */
  std::vector<std::pair<std::size_t, std::size_t>>
  copies() const;

  const Eigen::Vector3d&
  worldOffset() const
  {
    return runs_[0].summary().world_offset;
  }
  /** \return [m] */
  double
  voxel() const
  {
    return prepared_->parameters().voxel.value;
  }
  /** \return further notes for the report */
  const std::vector<std::string>&
  notes() const
  {
    return notes_;
  }

private:
  std::vector<Points>
  read(const ChangesSettings& settings,
       std::size_t run,
       const ProgressCallback& show) const;

  std::vector<RunFolder> runs_;
  std::vector<std::vector<std::size_t>> places_; ///< in the summaries
  std::vector<std::string> notes_;
  std::optional<PreparedScans> prepared_; ///< scans of A, then scans of B
};

} // namespace pcl6d::app
