// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "doctor/diagnosis.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

/** \file The reports: text, HTML and JSON say the same. */
namespace pcl6d::app {

using Cells = std::vector<std::string>;

/** \brief A table as both reports print it. */
struct ReportTable {
  Cells heads;
  std::vector<Cells> rows;
};

/** \return a row for each cloud: points, extent, spacing and so on */
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

/** \return a page that needs nothing else */
std::string
htmlReport(const Diagnosis& diagnosis);

/** \return both clouds, thinned, as they lie at a pose, from the side that shows most of
 * them: a drawing for HTML; empty without points */
std::string
svgOfPose(const DoctorPair& pair, const Eigen::Isometry3d& pose);

nlohmann::ordered_json
jsonReport(const Diagnosis& diagnosis);

} // namespace pcl6d::app
