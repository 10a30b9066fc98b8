// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/registration/pcl/icp6d_with_normals.h>

namespace pcl6d {
PCL6D_DEFINE_PAIR_INSTANCES(ICP6DWithNormals)
} // namespace pcl6d
