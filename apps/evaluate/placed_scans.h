// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/run_result.h>

#include <cstddef>
#include <vector>

namespace pcl6d::app {

/** \return places of the scans that a run ties to its world */
std::vector<std::size_t>
placedScans(const RunResult& run);

} // namespace pcl6d::app
