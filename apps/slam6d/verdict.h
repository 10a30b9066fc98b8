// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/run/run_summary.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <string>

namespace pcl6d::app {

/** \return in words: how many scans were registered, which are not to be trusted, the worst
 * numbers, and what became of each stage
 * \param[in] summary of the result, all but its verdict */
std::string
verdictOf(const Slam6DResult& result, const RunResult& summary);

} // namespace pcl6d::app
