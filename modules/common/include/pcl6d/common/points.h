// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Geometry>

#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The compiled core's view of a cloud: contiguous float x, y, z [m], in the frame of the
 * scan. \ingroup common */
using Points = std::vector<Eigen::Vector3f>;

/** \brief Copies the coordinates of a cloud of PCL, NaN points included.
 * \param[in] cloud a pcl::PointCloud, or any range of points with x, y and z */
template <typename Cloud>
Points
toPoints(const Cloud& cloud)
{
  Points points;
  points.reserve(cloud.size());
  for (const auto& p : cloud)
    points.emplace_back(p.x, p.y, p.z);
  return points;
}

/** \brief Copies the coordinates of selected points of a cloud of PCL, in the order of the
 * indices.
 * \param[in] indices pcl::Indices, or any range of integers below the cloud's size */
template <typename Cloud, typename Indices>
Points
toPoints(const Cloud& cloud, const Indices& indices)
{
  Points points;
  points.reserve(indices.size());
  for (const auto index : indices)
    points.emplace_back(cloud[index].x, cloud[index].y, cloud[index].z);
  return points;
}

/** \brief Moves points by a rigid motion; computed in double, rounded once. */
inline Points
transformed(const Points& points, const Eigen::Isometry3d& motion)
{
  Points moved;
  moved.reserve(points.size());
  for (const auto& p : points)
    moved.push_back((motion * p.cast<double>()).cast<float>());
  return moved;
}

} // namespace pcl6d
