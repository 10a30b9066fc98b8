// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace pcl6d::benchmarks {

/** \brief One plane by PlaneSACSegmentation beside pcl::SACSegmentation, only the
 * class's name changed: recorded clouds, thresholds of 1, 2 and 5 cm, PCL's 50
 * iterations and 1000. A case fails if our plane has fewer points. And the largest
 * plane of an organized scene by RegionGrowingPlaneSegmentation, which has no
 * threshold.
 * \param[in] threads that ours may use, case by case */
void
addPlaneSacCases(const std::vector<unsigned int>& threads);

} // namespace pcl6d::benchmarks
