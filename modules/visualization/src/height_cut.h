// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/top_view.h>

namespace pcl6d {

/** \brief The points that a top view shows. */
struct ShownPoints {
  std::vector<std::size_t> indices; ///< into the scene's points, ascending; all finite
  bool ceiling_hidden = false;
};

/** \brief Leaves out NaN points, those above max_height, and a ceiling if there is one.
 *
 * There is a ceiling if most of the map within 1.5 m of the trajectory is covered by
 * points that lie more than cut_above_trajectory above the nearest pose. Under an open
 * sky it is not, whatever facades and trees stand farther away. All points that much
 * above the path are then left out: rooms become a floor plan. */
ShownPoints
shownPoints(const TopViewScene& scene, const TopViewOptions& options);

} // namespace pcl6d
