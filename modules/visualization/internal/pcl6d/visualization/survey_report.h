// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/run/survey_options.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A value with its assessment. */
struct SurveyCell {
  enum class Mark { kPlain, kPass, kFail };
  std::string text;
  Mark mark = Mark::kPlain;
};

/** \brief A table of a survey report: cells as displayed, numbers with a decimal point. */
struct SurveyTable {
  std::string name;                 ///< name of the CSV file and XML element: "links"
  std::string title;                ///< heading
  std::string note;                 ///< below the heading; may be empty
  std::vector<std::string> columns; ///< names with their units: "overlap [%]"
  std::vector<std::vector<SurveyCell>> rows; ///< one cell per column
};

/** \brief How a registration is assessed. */
enum class SurveyVerdict {
  kAccepted,    ///< the verification is reliable, and requirements are met
  kConditional, ///< not contradicted, but unverified or with blunders
  kRejected     ///< unreliable, or a requirement is not met
};

/** \brief The content of a survey report. \ingroup visualization */
struct SurveyReport {
  std::string title;
  std::vector<std::pair<std::string, std::string>> header; ///< name, value
  SurveyVerdict verdict = SurveyVerdict::kConditional;
  std::vector<std::string> reasons; ///< of the verdict, a sentence each
  /** requirements, stations, links, control and check points; without empty tables */
  std::vector<SurveyTable> tables;
  std::vector<std::string> stations;         ///< names of the scans
  std::vector<std::vector<double>> overlaps; ///< [0, 1] of two stations; NaN: no link
  std::vector<double> link_errors;           ///< [m] rms of the pairs of each used link
  std::string top_view;                      ///< PNG; empty: none
};

/** \return the content of the report of a finished run. The bundle error is the root mean
 * square of the point-pair distances over the used links. The requirements compare with the
 * tolerance: check points, used control points, and the 95 % bounds of station positions.
 * \throws IoFailed a table of the run is broken \throws BadArgument an option is invalid */
SurveyReport
surveyOf(const RunFolder& run, const SurveyOptions& options = {});

/** \brief Writes a report as a self-contained HTML file for A4 pages. Atomically.
 * \throws IoFailed the file cannot be written \ingroup visualization */
void
writeSurveyReport(const std::filesystem::path& path, const SurveyReport& report);

/** \brief Writes the tables beside a report: BASE_stations.csv, BASE_links.csv and
 * further tables, and a BASE.xml with every table, header and verdict. Atomically.
 * \param[in] base path without extension \return the files
 * \throws IoFailed a file cannot be written \ingroup visualization */
std::vector<std::filesystem::path>
writeSurveyTables(const std::filesystem::path& base, const SurveyReport& report);

} // namespace pcl6d
