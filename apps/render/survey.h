// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief Settings of `report --survey`. */
struct SurveySettings {
  bool is_wanted = false;
  std::vector<std::string> project; ///< key=value; empty: from the run
  std::string tolerance;            ///< with its unit; empty: from the run
  bool pdf = false;
};

/** \brief Writes the survey report of a run: a page, its tables and, if asked for, a PDF.
 * \param[in] output the page \return the files
 * \throws IoFailed, BadArgument as surveyOf(); IoFailed Chromium is missing, or wrote no PDF */
std::vector<std::filesystem::path>
writeSurvey(const std::string& run,
            const std::filesystem::path& output,
            const SurveySettings& settings);

} // namespace pcl6d::app
