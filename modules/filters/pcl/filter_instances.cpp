// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/filters/pcl/approximate_voxel_grid.h>
#include <pcl6d/filters/pcl/median_filter.h>
#include <pcl6d/filters/pcl/octree_reduction.h>
#include <pcl6d/filters/pcl/range_gate.h>
#include <pcl6d/filters/pcl/scan_line_median.h>
#include <pcl6d/filters/pcl/scan_line_reduction.h>
#include <pcl6d/filters/pcl/uniform_sampling.h>

#include <pcl/filters/impl/filter_indices.hpp>

namespace pcl6d {
PCL6D_DEFINE_INSTANCES(ApproximateVoxelGrid)
PCL6D_DEFINE_INSTANCES(MedianFilter)
PCL6D_DEFINE_INSTANCES(OctreeReduction)
PCL6D_DEFINE_INSTANCES(RangeGate)
PCL6D_DEFINE_INSTANCES(ScanLineMedian)
PCL6D_DEFINE_INSTANCES(ScanLineReduction)
PCL6D_DEFINE_INSTANCES(UniformSampling)
} // namespace pcl6d
