// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pcl6d::visualization {

/** \brief The page of reports, which lacks but the data of a run, in place of
 * kReportPlace. Made in report/ by `npm ci && npm run build`. */
extern const char* const kReportPage;

constexpr const char* kReportPlace = "{{run}}";

} // namespace pcl6d::visualization
