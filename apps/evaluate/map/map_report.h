// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/map/map_source.h"

#include <pcl6d/benchmarking/map_quality.h>

#include <iosfwd>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Content of the report on a map. */
struct MapReport {
  MapSource source;
  std::vector<std::string> names; ///< of the scans
  std::string pose_source;
  double voxel = 0; ///< [m]
  MapQuality quality;
};

/** \brief Prints the measures, the scans worst first (at most `rows` scans), and the
 * verdict in the last line. */
void
printTable(const MapReport& report, std::size_t rows);

/** \return every number as JSON; null for missing measures */
std::string
toJson(const MapReport& report);

/** \brief Writes a row per scan, in their order; missing measures are empty. */
void
writeCsv(std::ostream& stream, const MapReport& report);

} // namespace pcl6d::app
