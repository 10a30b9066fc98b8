// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/scan_folder.h>
#include <pcl6d/run/run_summary.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <filesystem>

namespace pcl6d::app {

/** \brief A finished run that goes on with further scans (--continue). */
class EarlierRun {
public:
  /** \param[in] folder of a run of pcl_slam6d
   * \throws IoFailed it is none, or was interrupted */
  explicit EarlierRun(const std::filesystem::path& folder);

  /** \brief Puts its scans before those of a folder. \throws IoFailed as
   * ScanFolder::continueRun() */
  void
  putBefore(ScanFolder& folder) const;

  /** \return what the run found of its i-th scan */
  ScanResult
  scan(std::size_t i) const;

  /** \return how many points of its i-th scan were not finite */
  std::size_t
  dropped(std::size_t i) const;

private:
  std::filesystem::path folder_;
  RunResult summary_;
};

} // namespace pcl6d::app
