// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/process/interrupt.h"
#include "common/progress_bar.h"
#include "evaluate/verify/verify_settings.h"

#include <pcl6d/verification/prepared_scans.h>

#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Scans with the poses to verify. */
struct VerifySource {
  std::vector<std::string> names;                         ///< of their files
  std::vector<std::size_t> indices;                       ///< numbers NNN of the scans
  std::vector<Eigen::Isometry3d> poses;                   ///< relative to world_offset
  Eigen::Vector3d world_offset = Eigen::Vector3d::Zero(); ///< [m]
  std::string pose_source;                                ///< for people
  /** per scan: found by place recognition alone; empty: no scan was */
  std::vector<bool> unsure;
  /** per scan: its pose is a prediction of the run; empty: no scan's is */
  std::vector<bool> unregistered;
  PreparedScans scans;
};

/** \brief Reads and prepares the scans.
 * \return empty if interrupted
 * \throws UsageError the options select no scan
 * \throws IoFailed a file or folder is missing or broken, no poses, or not one per scan
 * \throws ComputeFailed a scan has fewer than 3 points within the range gate */
std::optional<VerifySource>
loadVerifySource(const VerifySettings& settings,
                 ProgressBar& bar,
                 const Interrupt& interrupt);

} // namespace pcl6d::app
