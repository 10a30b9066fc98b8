// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/filters/pcl/normal_estimation.h>

#include <pcl/point_types.h>

#define PCL6D_DEFINE_NORMALS_(Class, PointT)                                           \
  template class Class<PointT, pcl::Normal>;                                           \
  template class Class<PointT, pcl::PointNormal>;

namespace pcl6d {
PCL6D_FOR_POINT_TYPES(PCL6D_DEFINE_NORMALS_, NormalEstimation)
} // namespace pcl6d
