// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/suite/suite_runs.h"

#include <pcl6d/benchmarking/suite_table.h>
#include <pcl6d/benchmarking/trust_table.h>

namespace pcl6d::app {

/** \brief A row of the table with its path. */
struct SuiteResult {
  SuiteRow row;
  Trajectory estimate; ///< empty without a result
};

/** \brief Results on one data set. */
struct DataResults {
  std::string data;
  Trajectory reference;             ///< may be empty
  std::vector<SuiteResult> results; ///< the odometry, if known, then the methods
};

/** \brief Measures the results of the runs. A result that cannot be measured becomes a
 * row with a message. */
std::vector<DataResults>
measureSuite(const Suite& suite,
             const SuiteFolder& folder,
             const std::vector<SuiteRun>& runs);

/** \return the rows, data set by data set */
std::vector<SuiteRow>
rowsOf(const std::vector<DataResults>& results);

/** \brief Compares the verdict of every run with the truth. Errors are position errors,
 * after moving the map onto the truth at its first scan with a true pose that is not
 * named as doubtful. A foreign scan has no true pose. Named scans: doubted or found
 * disconnected by verification, not matched, or without links to the other scans. */
std::vector<TrustRun>
evaluateSuite(const Suite& suite,
              const SuiteFolder& folder,
              const std::vector<SuiteRun>& runs);

/** \brief Draws for every data set the paths in one picture, the error over the index
 * of the scan, and the error over time, as DATA_paths.png, DATA_errors.png and
 * DATA_times.png. \throws IoFailed a picture cannot be drawn or written */
void
drawSuite(const std::filesystem::path& folder, const std::vector<DataResults>& results);

/** \return title, description, table, a sentence on the table, machine, options of the
 * methods and the command, in Markdown. \param[in] command that makes the document */
std::string
documentOf(const Suite& suite,
           const std::string& table,
           const std::string& sentence,
           const std::string& command);

/** \brief Puts a text into a Markdown file, between the lines `<!-- suite NAME -->` and
 * `<!-- end of suite NAME -->`, appended with the text if missing; the rest of the file
 * stays.
 * \throws IoFailed only one of the lines is present, or the file cannot be read or written */
void
putIntoDocument(const std::filesystem::path& file,
                const std::string& name,
                const std::string& text);

} // namespace pcl6d::app
