// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/suite/suite_file.h"

namespace pcl6d::app {

/** \brief Checks a suite before the first run. pcl_slam6d and pcl_slam6d_simulate must
 * accept the options, each set alone and with the options of every data set; scans,
 * poses and reference of every folder must be readable. The working folder must be the
 * folder of the suite file.
 * \throws UsageError naming file, position (a JSON pointer) and error */
void
checkSuite(const Suite& suite);

} // namespace pcl6d::app
