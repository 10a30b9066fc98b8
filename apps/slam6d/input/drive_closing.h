// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "slam6d/options/settings.h"

#include <pcl6d/common/progress.h>
#include <pcl6d/io/scan_folder.h>

namespace pcl6d::app {

/** \brief Detects loops of a tracked drive that its drift hides from the search by poses
 * (closeDriveLoops()), and replaces the initial poses by poses with closed loops. Reads the scans
 * only if loops are possible. poseSource() contains the result.
 * \param[in] progress may throw to end the work
 * \throws IoFailed a scan cannot be read */
void
closeLoopsOfDrive(const Settings& settings,
                  ScanFolder& folder,
                  const ProgressCallback& progress);

} // namespace pcl6d::app
