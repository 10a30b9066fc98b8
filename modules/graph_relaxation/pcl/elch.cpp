// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/graph_relaxation/pcl/elch.h>

namespace pcl6d {
PCL6D_DEFINE_INSTANCES(ELCH)
} // namespace pcl6d
