// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <vector>

/** \file Widths of clusters, to tell things from the edges and lines that rays pass beside. */
namespace pcl6d::moving_objects {

/** \return the width of points across the direction of their largest spread, in their unit: of
 * points spread evenly, the distance between their borders */
double
widthOf(const std::vector<Eigen::Vector3d>& points);

/** \return [rad] the width of directions (of length 1) across the arc that they follow. The
 * directions to a pole nearby are a great circle, which is straight on the sphere, but not in
 * space */
double
arcWidthOf(const std::vector<Eigen::Vector3d>& directions);

/** \return mean square of the points about their middle, in their unit squared */
Eigen::Matrix3d
scatterOf(const std::vector<Eigen::Vector3d>& points);

/** \return the narrow and the wide extent of a surface of given scatter, seen along a direction */
Eigen::Vector2d
seenExtentOf(const Eigen::Matrix3d& scatter, const Eigen::Vector3d& direction);

} // namespace pcl6d::moving_objects
