// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/top_view.h>

namespace pcl6d::visualization {

/** \return the part of the world shown by default in a top view of the scene
 * \throws BadArgument the scene is empty (no point, pose or overlay), or the cut leaves
 * no point */
Eigen::AlignedBox2d
areaOf(const TopViewScene& scene, const TopViewOptions& options);

} // namespace pcl6d::visualization
