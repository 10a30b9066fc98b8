// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/changes_settings.h"

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

/** \brief Two runs that are compared: their scans that have a sure place, made ready. */
class ComparedRuns {
public:
  /** \param[in] show told of "reading"; may throw
   * \throws IoFailed a folder holds no finished run, a file is not as it was written, no scan
   * has a place, or the units differ \throws ComputeFailed too few points */
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
  /** \return its run and its name there, for messages */
  std::string
  name(std::size_t run, std::size_t i) const;

  /** \return the scans of a run with their poses relative to the world offset of A */
  ComparedRun
  compared(std::size_t run) const;

  /** \return a scan of A that holds the very same points as one of B: the pair; none: empty */
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
  /** \return what is to be said besides */
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
  std::optional<PreparedScans> prepared_; ///< those of A, then those of B
};

} // namespace pcl6d::app
