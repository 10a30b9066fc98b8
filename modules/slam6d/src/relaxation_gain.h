// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/graph_relaxation/graph_slam.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <string>

namespace pcl6d::slam6d {

/** \return why a relaxation is not taken that the agreement has nothing against: it found
 * no answer, its links close no cycle, or little is gained; empty: it is taken
 * \param[in] stage with the agreement before and after */
std::string
whyNotTaken(const GraphSlamResult& relaxed, const StageResult& stage);

} // namespace pcl6d::slam6d
