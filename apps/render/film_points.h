// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/visualization/height_cut.h>

#include <array>
#include <cstddef>
#include <vector>

namespace pcl6d::app {

/** \return ascending indices of the visible points, evenly thinned to at most `most` */
std::vector<std::size_t>
chosenPoints(const Points& points,
             const Trajectory& path,
             const HeightCut& cut,
             std::size_t most);

/** \return the median of the points in x, y and z \param[in] points not empty */
Eigen::Vector3d
middleOf(const Points& points);

/** \return the range of heights [m] of nearly every point near the path */
std::array<double, 2>
heightsAlong(const Trajectory& path, const Points& points);

} // namespace pcl6d::app
