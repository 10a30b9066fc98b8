// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/suite_runs.h"

#include <pcl6d/benchmarking/suite_table.h>
#include <pcl6d/benchmarking/trust_table.h>

namespace pcl6d::app {

/** \brief A row of the table with the paths that it was measured on. */
struct SuiteResult {
  SuiteRow row;
  Trajectory estimate; ///< empty without a result
};

/** \brief What came out on one data set. */
struct DataResults {
  std::string data;
  Trajectory reference; ///< empty if there is none
  std::vector<SuiteResult>
      results; ///< the odometry, if a run knows it, then the methods
};

/** \brief Measures what the runs have left. A result that cannot be measured is a row with a
 * message. */
std::vector<DataResults>
measureSuite(const Suite& suite,
             const SuiteFolder& folder,
             const std::vector<SuiteRun>& runs);

/** \return all rows, data set by data set */
std::vector<SuiteRow>
rowsOf(const std::vector<DataResults>& results);

/** \brief Compares what every run says of its map with the truth. Errors are of positions,
 * after moving the map so that its first scan that is not named as doubtful, and has a
 * true place, is right. A foreign scan has no true place. Named are scans that
 * verification doubts or does not find tied, and those that were not matched or that no
 * link joins to the others. */
std::vector<TrustRun>
judgeSuite(const Suite& suite,
           const SuiteFolder& folder,
           const std::vector<SuiteRun>& runs);

/** \brief Draws for every data set the paths over each other, the error over the index of
 * the scan and the error over the time, as DATA_paths.png, DATA_errors.png and
 * DATA_times.png. \throws IoFailed a picture cannot be drawn or written */
void
drawSuite(const std::filesystem::path& folder, const std::vector<DataResults>& results);

/** \return title, description, table, a sentence on it, machine, options of the methods and
 * the command, in Markdown. \param[in] command that makes it */
std::string
documentOf(const Suite& suite,
           const std::string& table,
           const std::string& sentence,
           const std::string& command);

/** \brief Puts a text into a Markdown file, between the lines `<!-- suite NAME -->` and
 * `<!-- end of suite NAME -->`, which are added with it at the end if they are missing; the
 * rest of the file stays. \throws IoFailed only one of the lines is there, or the file
 * cannot be read or written */
void
putIntoDocument(const std::filesystem::path& file,
                const std::string& name,
                const std::string& text);

} // namespace pcl6d::app
