// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/registration/pcl/ndt6d.h>

namespace pcl6d {
PCL6D_DEFINE_PAIR_INSTANCES(NDT6D)
} // namespace pcl6d
