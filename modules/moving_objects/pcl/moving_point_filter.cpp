// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/moving_objects/pcl/moving_point_filter.h>

#include <pcl/filters/impl/filter_indices.hpp>

namespace pcl6d {
PCL6D_DEFINE_INSTANCES(MovingPointFilter)
} // namespace pcl6d
