// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/report.h>

#include <string>

namespace pcl6d::visualization {

/** \return the data of a report as JSON for a script element: pure ASCII, without `<`.
 * The page reads this JSON in report/src/run.js. Infinite and NaN numbers become null. */
std::string
reportJson(const ReportData& data, const ReportOptions& options);

} // namespace pcl6d::visualization
