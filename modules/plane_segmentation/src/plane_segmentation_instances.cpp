// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/plane_segmentation/plane_segmentation.h>

#include <pcl/impl/pcl_base.hpp>

namespace pcl6d {
PCL6D_DEFINE_INSTANCES(PlaneSegmentation)
PCL6D_DEFINE_INSTANCES(RegionGrowingPlaneSegmentation)
} // namespace pcl6d
