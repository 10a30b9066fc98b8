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

/** \return the width of points across the rays from a position, in their unit */
double
seenWidthOf(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& from);

} // namespace pcl6d::moving_objects
