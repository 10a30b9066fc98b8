// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/benchmarking/relative_error.h>
#include <pcl6d/benchmarking/trajectory_error.h>
#include <pcl6d/common/export.h>

#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Result of one method on one data set. \ingroup benchmarking */
struct SuiteRow {
  std::string data;
  std::string method;
  std::optional<TrajectoryEvaluation> errors; ///< empty: no result, or no reference
  std::optional<RelativeErrors> steps; ///< RPE from each compared pose to the next
  std::optional<DriftErrors> drift;    ///< RPE per distance
  std::optional<double> agreement;     ///< of the scans, from summary.json
  std::optional<double> seconds;       ///< of the clock; of several runs the median
  std::optional<double> cpu_seconds;
  std::optional<double> peak_memory_mb; ///< largest of several runs [MB]
  int runs = 0;                         ///< number of timed runs; 0: not run
  std::string verdict;                  ///< "reliable", "timed out", ...; may be empty
  std::string message;                  ///< reason of a missing result; else empty
};

/** \brief The table of the book (6.4.3) with more columns, for people: errors without
 * alignment in m and degrees, agreement, time, memory and verdict, with fewer columns
 * than suiteCsv(); "-" for a missing number, and a list of the messages below. An empty
 * column is left out, and the data column if it has a single value. */
std::string
suiteMarkdown(const std::vector<SuiteRow>& rows);

/** \brief The rows as CSV for programs: one line per row below the column names, every
 * column, units at the end of the names, angles in radians, empty for a missing number.
 * Texts are quoted as in RFC 4180 if necessary. */
std::string
suiteCsv(const std::vector<SuiteRow>& rows);

/** \brief `{"schema_version": 1, "rows": [...]}` with the columns of suiteCsv() and the
 * errors with alignment; null for a missing number. */
std::string
suiteJson(const std::vector<SuiteRow>& rows);

} // namespace pcl6d
