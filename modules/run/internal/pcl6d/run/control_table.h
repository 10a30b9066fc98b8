// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>

#include <filesystem>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Writes control.csv, atomically: a row for each target of a control point, with name,
 * scan, use, residual [m] in x, y, z and length, standardised residual, detectable error [m]
 * (empty: infinite). \param[in] run with control points \throws IoFailed the file cannot be
 * written \ingroup run */
void
writeControlTable(const std::filesystem::path& path, const RunResult& run);

/** \return the result of the adjustment to control points, in words, a line each: residuals of
 * control and check points, blunders by name, doubts; empty without control points
 * \ingroup run */
std::string
controlWords(const RunResult& run);

} // namespace pcl6d
