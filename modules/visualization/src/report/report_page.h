// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pcl6d::visualization {

/** \brief HTML page of reports; the data of a run replaces kReportPlace. Made in
 * report/ by `npm ci && npm run build`. */
extern const char* const kReportPage;

constexpr const char* kReportPlace = "{{run}}";

} // namespace pcl6d::visualization
