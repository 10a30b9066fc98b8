// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/plane_segmentation/pcl/plane_segmentation.h>

#include <pcl/impl/pcl_base.hpp>

namespace pcl6d {
PCL6D_DEFINE_INSTANCES(PlaneSegmentation)
PCL6D_DEFINE_INSTANCES(RegionGrowingPlaneSegmentation)
PCL6D_DEFINE_INSTANCES(RansacPlaneSegmentation)
PCL6D_DEFINE_INSTANCES(HoughPlaneSegmentation)
} // namespace pcl6d
