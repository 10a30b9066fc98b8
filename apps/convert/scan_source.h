// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "convert/scan_settings.h"

#include <cstdint>
#include <limits>

namespace pcl6d::app {

/** \brief The scans of a folder and their poses: raw ones, or those of a finished run of
 * pcl_slam6d. */
class ScanSource {
public:
  /** \throws IoFailed, BadArgument as ScanFolder; the run's summary is broken, or it was
   * interrupted ahead of its scans */
  explicit ScanSource(const ScanSettings& settings);

  const ScanFolder&
  folder() const
  {
    return folder_;
  }

  /** \return the pose of the i-th scan in full coordinates */
  Eigen::Isometry3d
  pose(std::size_t i) const;

  /** \return the number NNN of the i-th scan in the files of the run; of raw scans the
   * place in the folder */
  std::uint32_t
  index(std::size_t i) const
  {
    return indices_[i];
  }

  /** \return what joined points are relative to [m]: the world offset of the run, or what
   * a run on these poses would take */
  const Eigen::Vector3d&
  worldOffset() const
  {
    return world_offset_;
  }

  /** \return the ranges [m] that the run took for surfaces; all if it is none */
  double
  minRange() const
  {
    return min_range_;
  }
  double
  maxRange() const
  {
    return max_range_;
  }

  /** \return where the poses come from, in words */
  std::string
  poseSource() const;

private:
  void
  readRun(const std::filesystem::path& summary);

  bool is_run_;
  ScanFolder folder_;
  Eigen::Vector3d world_offset_;
  std::vector<std::uint32_t> indices_;
  double min_range_ = 0;
  double max_range_ = std::numeric_limits<double>::infinity();
};

} // namespace pcl6d::app
