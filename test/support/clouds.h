// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>

#include <pcl/memory.h>
#include <pcl/point_cloud.h>

namespace pcl6d::test {

/** \return a cloud of the points; other fields as the point type sets them up */
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
toCloud(const Points& points)
{
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>();
  for (const auto& p : points) {
    PointT point;
    point.getVector3fMap() = p;
    cloud->push_back(point);
    cloud->is_dense = cloud->is_dense && p.allFinite();
  }
  return cloud;
}

} // namespace pcl6d::test
