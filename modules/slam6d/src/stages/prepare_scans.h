// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "../pipeline/slam_state.h"

namespace pcl6d::slam6d {

/** Prepares the waiting scans, also while scans are added. The first call derives the parameters
 * from the waiting scans.
 * \param[in] report of progress, see KeptScans::prepare(); may be null
 * \throws ComputeFailed, RankFailed */
void
prepareWaiting(SlamState& state, const ProgressCallback& report);

} // namespace pcl6d::slam6d
