// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include <vector>

/** \file Convex polygons in space. Internal to the module scene_interpretation. */
namespace pcl6d {

using Corners = std::vector<Eigen::Vector3d>;

/** \return the extent of points along a unit vector */
double
extentAlong(const Corners& corners, const Eigen::Vector3d& direction);

/** \return the centre of the area of a polygon; the mean of its corners if it has none
 * */
Eigen::Vector3d
centreOfArea(const Corners& corners);

/** \return whether a line in plan that follows an edge of a, or stands on it, parts the
 * polygons by more than margin (separating axes) */
bool
apartAcrossEdgesOf(const Corners& a, const Corners& b, double margin);

/** \return the smallest distance between the edges of both polygons, or from an edge of
 * b to the inside of a. \param[in] normal of a */
double
hullToHull(const Corners& a, const Eigen::Vector3d& normal, const Corners& b);

/** \return whether a point, seen along the normal, lies in a convex polygon that was
 * grown by margin */
bool
isInside(const Corners& polygon,
         const Eigen::Vector3d& normal,
         const Eigen::Vector3d& point,
         double margin);

} // namespace pcl6d
