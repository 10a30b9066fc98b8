// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/trust_table.h>
#include <pcl6d/common/run_result.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <vector>

namespace pcl6d::app {

/** \return for each scan of a run, whether the run reports the scan as unreliable: doubted or found
 * disconnected by verification, not matched, or without links to the other scans */
std::vector<bool>
namedScans(const RunResult& run);

/** \brief Compares the map of a run with the truth. Errors are position errors, after moving the map
 * onto the truth at its first scan with a true pose that is not named.
 * \param[in] named for each scan: reported as unreliable
 * \param[in] truth T_world_scan of every scan in the folder
 * \param[in] foreign index of the scan without a true pose in the map
 * \return one per scan; empty if no scan has a true pose */
std::vector<TrustScan>
compareWithTruth(const RunResult& run,
                 const std::vector<bool>& named,
                 const std::vector<Eigen::Isometry3d>& truth,
                 std::optional<std::size_t> foreign);

} // namespace pcl6d::app
