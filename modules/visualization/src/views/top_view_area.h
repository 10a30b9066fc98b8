// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/top_view.h>

namespace pcl6d::visualization {

/** \return the part of the world that a top view of the scene shows by itself
 * \throws BadArgument there is nothing to draw: no point, pose or overlay; or the cut
 * leaves none of several points */
Eigen::AlignedBox2d
areaOf(const TopViewScene& scene, const TopViewOptions& options);

} // namespace pcl6d::visualization
