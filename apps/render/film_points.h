// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/visualization/height_cut.h>

#include <array>
#include <cstddef>
#include <vector>

namespace pcl6d::app {

/** \return the places of the points that a picture shows, ascending; at most so many,
 * evenly left out */
std::vector<std::size_t>
chosenPoints(const Points& points,
             const Trajectory& path,
             const HeightCut& cut,
             std::size_t most);

/** \return the median of the points in x, y and z; there must be one */
Eigen::Vector3d
middleOf(const Points& points);

/** \return the heights [m] between which nearly all lies that is near the path */
std::array<double, 2>
heightsAlong(const Trajectory& path, const Points& points);

} // namespace pcl6d::app
