// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Additional content of a survey report. */
struct SurveyOptions {
  /** header entries in order: project, client, operator, instrument, date, coordinate-system, or
   * any further key */
  std::vector<std::pair<std::string, std::string>> project;
  std::optional<double>
      tolerance; ///< [m] limit of the requirements; finite, > 0; none: no limit
  /** \throws BadArgument naming the first invalid field, with its value */
  void
  validate() const;
};

/** \brief Reads command-line values. \param[in] project entries key=value; a text may have several
 * entries, a line each \param[in] tolerance a length with its unit (5mm, 0.5cm, 0.005m) or in
 * metres; empty: none \throws BadArgument an entry without a key, or an invalid length */
SurveyOptions
surveyOptionsFrom(const std::vector<std::string>& project,
                  const std::string& tolerance);

} // namespace pcl6d
