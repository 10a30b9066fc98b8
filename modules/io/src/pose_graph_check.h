// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/pose_graph.h>

namespace pcl6d {

/** \brief Refuses what readPoseGraph() would not read again. Internal to the module io.
 * \throws BadArgument see writePoseGraphG2o() */
void
checkGraphToWrite(const PoseGraph& graph);

} // namespace pcl6d
