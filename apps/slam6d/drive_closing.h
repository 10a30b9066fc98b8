// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"
#include "slam6d/settings.h"

#include <pcl6d/io/scan_folder.h>

namespace pcl6d::app {

/** \brief Detects loops of a tracked drive that its drift hides from the search by poses
 * (closeDriveLoops()), and replaces the initial poses by poses with closed loops. Reads the scans
 * only if loops are possible. poseSource() contains the result.
 * \throws IoFailed a scan cannot be read */
void
closeLoopsOfDrive(const Settings& settings, ScanFolder& folder, ProgressBar& bar);

} // namespace pcl6d::app
