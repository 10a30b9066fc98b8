// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "doctor/diagnosis.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

/** \file The reports: text, HTML and JSON have equal content. */
namespace pcl6d::app {

using Cells = std::vector<std::string>;

/** \brief A table for the text and HTML reports. */
struct ReportTable {
  Cells heads;
  std::vector<Cells> rows;
};

/** \return a row for each cloud: points, extent, spacing and further measures */
ReportTable
cloudTable(const Diagnosis& diagnosis);

/** \return a row for each run of a class */
ReportTable
classTable(const Diagnosis& diagnosis);

/** \return where the start, the distances and the scanner come from */
std::vector<std::string>
settingLines(const Diagnosis& diagnosis);

/** \return captions and matrices, each of four lines, of the poses to take over */
std::vector<std::pair<std::string, std::vector<std::string>>>
poseBlocks(const Diagnosis& diagnosis);

std::string
textReport(const Diagnosis& diagnosis);

/** \return a self-contained HTML page */
std::string
htmlReport(const Diagnosis& diagnosis);

/** \return drawing (SVG) of both clouds, thinned, at a pose, seen from the side with
 * the largest extent; empty without points */
std::string
svgOfPose(const DoctorPair& pair, const Eigen::Isometry3d& pose);

nlohmann::ordered_json
jsonReport(const Diagnosis& diagnosis);

} // namespace pcl6d::app
