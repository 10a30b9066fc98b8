// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/options/settings.h"

namespace pcl6d::app {

/** \brief Prints the plan of a run: scans and their order, initial poses, derived parameters,
 * expected memory and time. The first scans are read and registered to measure time; no file is
 * written.
 * \return the exit code \throws UsageError for joined or continued runs
 * \throws IoFailed, BadArgument, ComputeFailed like the run */
int
explainRun(const Settings& given);

} // namespace pcl6d::app
