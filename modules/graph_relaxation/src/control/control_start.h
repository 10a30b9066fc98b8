// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace pcl6d::graph_relaxation {

/** \brief A motion from a few point pairs with outliers. */
struct ControlStart {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity(); ///< source to target
  std::vector<std::size_t> pairs; ///< inliers: the best-fitting pairs, more than half
};

/** \return the motion with the least sum over the smallest squared distances, of more than half
 * of the pairs and at least 3; no pairs if every triple is on a line
 * \param[in] source, target [m] of equal size, at least 3 */
ControlStart
startOfControl(const std::vector<Eigen::Vector3d>& source,
               const std::vector<Eigen::Vector3d>& target);

/** \return [m] root mean square distance of points from their best-fitting line */
double
spreadAcrossLine(const std::vector<Eigen::Vector3d>& points);

} // namespace pcl6d::graph_relaxation
