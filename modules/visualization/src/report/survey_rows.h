// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/run_result.h>
#include <pcl6d/visualization/survey_report.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

/** \file The tables of a survey report. */
namespace pcl6d::visualization {

/** \return a length in millimetres with one digit; "-" if not finite */
std::string
millimetresOf(double metres);

/** \return the name of the scan's file without its extension */
std::string
stationName(const ScanResult& scan);

/** \return indices of scans by the numbers of their files */
std::map<int, std::size_t>
placesByIndex(const RunResult& run);

/** \return [m] 95 % bound of a station's position: in the control frame if the map was
 * adjusted to it, else relative to the first station; empty: not connected, or not verified */
std::optional<double>
boundOfStation(const RunResult& run, std::size_t place);

/** \brief A row for each target: use, residuals, test value, detectable error. */
SurveyTable
controlTable(const RunResult& run);

/** \brief A row for each station: coordinates, links, overlap, bound, state. */
SurveyTable
stationTable(const RunResult& run);

/** \brief A row for each used link, in the order of links.csv.
 * \param[in] checks of the verification, by the indices of the scans */
SurveyTable
linkTable(const RunResult& run, const std::vector<LinkCheck>& checks);

} // namespace pcl6d::visualization
