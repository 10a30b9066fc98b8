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
      height;             ///< [m] of its middle; by default that of the nearest pose
  double thickness = 0.2; ///< [m] > 0
};

/** \brief Which points a picture leaves out by their height. \ingroup visualization */
struct HeightCut {
  /** [m] points above are left out; by default, if the map has a ceiling, what is higher
   * than above_trajectory above the nearest pose; infinity: draw all */
  std::optional<double> max_height;
  double above_trajectory = 0.5;    ///< [m] see max_height
  std::optional<HeightSlice> slice; ///< only this layer

  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief The points that a picture shows. */
struct ShownPoints {
  std::vector<std::size_t> indices; ///< into the points, ascending; all finite
  bool ceiling_hidden = false;
};

/** \brief Leaves out NaN points and those outside the cut, and a ceiling if there is one.
 *
 * There is a ceiling if most of the map within 1.5 m of the trajectory is covered by
 * points that lie more than above_trajectory above the nearest pose. Under an open
 * sky it is not, whatever facades and trees stand farther away. All points that much
 * above the path are then left out: rooms become a floor plan.
 * \throws BadArgument the slice follows the path, but there is none */
ShownPoints
shownPoints(const Points& points, const Trajectory& trajectory, const HeightCut& cut);

} // namespace pcl6d
