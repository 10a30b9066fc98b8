// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/run_result.h>

#include <cstddef>
#include <vector>

namespace pcl6d::app {

/** \return indices of the scans connected to the world of a run */
std::vector<std::size_t>
placedScans(const RunResult& run);

} // namespace pcl6d::app
