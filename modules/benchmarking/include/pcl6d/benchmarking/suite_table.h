// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/relative_error.h>
#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/common/export.h>

#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief What came out of one method on one data set. \ingroup benchmarking */
struct SuiteRow {
  std::string data;
  std::string method;
  std::optional<TrajectoryEvaluation> errors; ///< none: no result, or no reference
  std::optional<RelativeErrors> steps; ///< RPE from each compared pose to the next
  std::optional<DriftErrors> drift;    ///< RPE per distance
  std::optional<double> agreement;     ///< of the scans, as in summary.json
  std::optional<double> seconds;       ///< of the clock; of several runs the median
  std::optional<double> cpu_seconds;
  std::optional<double> peak_memory_mb; ///< largest of several runs [MB]
  int runs = 0;                         ///< that the times are of; 0: nothing was run
  std::string verdict;                  ///< "trusted", "timed out", ...; may be empty
  std::string message;                  ///< why there is no result; else empty
};

/** \brief The table of the book (6.4.3) with more columns, for people: errors without
 * alignment in m and degrees, agreement, time, memory and verdict, not all that
 * suiteCsv() has; "-" where there is no
 * number, and a list of the messages below. A column that is empty in all rows is left
 * out, that of the data too if all rows have the same. */
std::string
suiteMarkdown(const std::vector<SuiteRow>& rows);

/** \brief The same for programs: one line per row under the names of the columns, all
 * columns, units at the end of their names, angles in radians, empty where there is no
 * number. Texts are quoted as in RFC 4180 where they must be. */
std::string
suiteCsv(const std::vector<SuiteRow>& rows);

/** \brief `{"schema_version": 1, "rows": [...]}` with the columns of suiteCsv() and the
 * errors with alignment; null where there is no number. */
std::string
suiteJson(const std::vector<SuiteRow>& rows);

} // namespace pcl6d
