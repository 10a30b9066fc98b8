// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/visualization/top_view.h>

namespace pcl6d {

/** \brief Chooses map area, scale and scale bar. \param[in] points finite, at least one
 */
TopViewLayout
layOut(const Points& points, const TopViewScene& scene, const TopViewOptions& options);

/** \brief The points of a scene that are left after the cut. */
struct PointsToDraw {
  ShownPoints shown;
  Points points; ///< those of shown
};

/** \throws BadArgument there is nothing to draw: no point, pose or overlay; or the cut
 * leaves none of several points */
PointsToDraw
pointsToDraw(const TopViewScene& scene, const TopViewOptions& options);

/** \return the part of the world that a top view of the scene shows by itself
 * \throws BadArgument as pointsToDraw() */
Eigen::AlignedBox2d
areaOf(const TopViewScene& scene, const TopViewOptions& options);

/** \return the longest of 1, 2 or 5 times a power of ten that is not longer [m] */
double
roundDown(double metres);

/** \return the value below which the given share of the values lies (nearest rank, from
 * an even sample of them); \param[in] values not empty */
float
quantile(std::vector<float> values, double share);

} // namespace pcl6d
