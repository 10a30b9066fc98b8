// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/trajectory_error.h>

#include <iosfwd>
#include <string>

namespace pcl6d::app {

/** \brief Content of the report on a comparison. */
struct TrajectoryReport {
  std::string estimate;  ///< file
  std::string reference; ///< file
  TrajectoryEvaluationOptions options;
  TrajectoryEvaluation evaluation;
};

/** \brief Prints the tables to stdout: lengths in m, angles in degrees. */
void
printTable(const TrajectoryReport& report);

/** \return every number as JSON, angles in radians (share/doc/measures.md) */
std::string
toJson(const TrajectoryReport& report);

/** \brief Writes a row per compared pose: its indices and errors [m, rad]; step errors
 * belong to the step that ends at the pose and are empty in the first row. */
void
writeCsv(std::ostream& stream, const TrajectoryReport& report);

} // namespace pcl6d::app
