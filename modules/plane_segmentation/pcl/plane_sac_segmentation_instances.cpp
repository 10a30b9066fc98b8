// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/plane_segmentation/pcl/plane_sac_segmentation.h>

namespace pcl6d {
PCL6D_FOR_PLANE_SAC_(PCL6D_PLANE_SAC_, )
} // namespace pcl6d
