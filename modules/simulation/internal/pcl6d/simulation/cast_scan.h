// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/scanner/range_scan.h>
#include <pcl6d/simulation/scene_view.h>

#include <Eigen/Geometry>

#include <cstdint>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Simulates a scan, each sample at its own time.
 * \param[in] scan_index number of the scan: each scan has its own noise
 * \throws BadArgument see RangeOptions::validate() \ingroup simulation */
RangeScan
castScan(const SceneView& view,
         const ScannerModel& scanner,
         const RangeOptions& options = {},
         std::uint64_t scan_index = 0);

/** \brief Simulates a scan from a fixed pose in a static scene.
 * \param[in] T_scene_scan pose of the scanner
 * \param[in] scan_index number of the scan: each scan has its own noise
 * \throws BadArgument see RangeOptions::validate() \ingroup simulation */
RangeScan
castScan(const RayCaster& caster,
         const ScannerModel& scanner,
         const Eigen::Isometry3d& T_scene_scan,
         const RangeOptions& options = {},
         std::uint64_t scan_index = 0);

} // namespace pcl6d
