// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/global_registration/pcl/vertical_estimation.h>

namespace pcl6d {
PCL6D_DEFINE_INSTANCES(VerticalEstimation)
} // namespace pcl6d
