// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/trajectory.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A horizontal layer of a map. */
struct HeightSlice {
  std::optional<double>
      height; ///< [m] height of the middle; by default the height of the nearest pose
  double thickness = 0.2; ///< [m] > 0
};

/** \brief Selection of the points of a picture by their height. \ingroup visualization */
struct HeightCut {
  /** [m] higher points are left out; by default, if the map has a ceiling, points more
   * than above_trajectory above the nearest pose; infinity: draw every point */
  std::optional<double> max_height;
  double above_trajectory = 0.5;    ///< [m] see max_height
  std::optional<HeightSlice> slice; ///< only this layer

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief The visible points of a picture. */
struct ShownPoints {
  std::vector<std::size_t> indices; ///< indices of points, ascending; each point finite
  bool ceiling_hidden = false;
};

/** \brief Leaves out NaN points, points outside the cut, and the ceiling if the map has
 * one.
 *
 * The map has a ceiling if points more than above_trajectory above the nearest pose
 * cover most of the map within 1.5 m of the trajectory. Facades and trees farther away
 * are ignored, so an open sky counts as no ceiling. With a ceiling, every point above
 * the limit is left out: rooms become a floor plan.
 * \throws BadArgument the slice follows the path, but the path is empty */
ShownPoints
shownPoints(const Points& points, const Trajectory& trajectory, const HeightCut& cut);

} // namespace pcl6d
