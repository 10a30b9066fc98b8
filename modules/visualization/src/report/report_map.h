// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/report.h>

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace pcl6d::visualization {

/** \brief Map of a report, in integer steps from a corner. */
struct ReportMap {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< [m]
  double step = 1;                                  ///< [m]
  std::vector<std::uint16_t> positions;             ///< x y z of each point, in steps
  std::vector<std::uint16_t> moving; ///< dynamic points, in the form of `positions`
  std::vector<std::uint16_t> scans;  ///< index of each point's scan, or empty
  std::vector<std::uint8_t>
      intensities;               ///< from the 1 % to the 99 % quantile, or empty
  std::optional<double> ceiling; ///< [m] above it a ceiling hides the rooms
};

/** \brief Thins and rounds a map and its dynamic points; see writeReport(). */
ReportMap
reportMapOf(const ReportData& data, std::size_t max_points);

} // namespace pcl6d::visualization
