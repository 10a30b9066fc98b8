// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/filters/octree_reduction.h>
#include <pcl6d/filters/range_gate.h>

#include <pcl/filters/impl/filter_indices.hpp>

namespace pcl6d {
PCL6D_DEFINE_INSTANCES(OctreeReduction)
PCL6D_DEFINE_INSTANCES(RangeGate)
} // namespace pcl6d
