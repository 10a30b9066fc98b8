// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/search/kd_tree.h>

namespace pcl6d {
PCL6D_DEFINE_INSTANCES(KdTree)
} // namespace pcl6d
