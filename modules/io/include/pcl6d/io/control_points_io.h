// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/control_points.h>
#include <pcl6d/common/export.h>

#include <filesystem>
#include <string>
#include <vector>

/** \file Tables of control points and targets as text. Columns are separated by commas,
 * semicolons, tabs or blanks; with semicolons and tabs, numbers may have decimal commas. Empty
 * lines, lines that start with # and a heading with column names are skipped. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief Reads control points: name x y z [sigma], in metres.
 * \throws IoFailed naming file, line and rule: unreadable, no points, a number of columns other
 * than 4 or 5, a coordinate that is not a finite number, sigma not above 0, a repeated name
 * \ingroup io */
std::vector<ControlPoint>
readControlPoints(const std::filesystem::path& path);

/** \brief Reads targets: name scan x y z, in metres in the scan's own frame. The scan is given
 * by file name, with or without extension, or by number.
 * \param[in] scans names of the scans \param[in] numbers of the scans, parallel to scans
 * \throws IoFailed naming file, line and rule: unreadable, no targets, a number of columns
 * other than 5, a coordinate that is not a finite number, an unknown scan, a name twice in one
 * scan
 * \ingroup io */
std::vector<ScanTarget>
readScanTargets(const std::filesystem::path& path,
                const std::vector<std::string>& scans,
                const std::vector<int>& numbers);

} // namespace pcl6d
