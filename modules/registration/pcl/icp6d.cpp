// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/registration/pcl/icp6d.h>

namespace pcl6d {
PCL6D_DEFINE_PAIR_INSTANCES(ICP6D)
} // namespace pcl6d
