// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/search/pcl/approximate_kd_tree.h>
#include <pcl6d/search/pcl/brute_force_search.h>
#include <pcl6d/search/pcl/cached_kd_tree.h>
#include <pcl6d/search/pcl/octree_search.h>

namespace pcl6d {
PCL6D_DEFINE_INSTANCES(KdTree)
PCL6D_DEFINE_INSTANCES(CachedKdTree)
PCL6D_DEFINE_INSTANCES(ApproximateKdTree)
PCL6D_DEFINE_INSTANCES(OctreeSearch)
PCL6D_DEFINE_INSTANCES(BruteForceSearch)
} // namespace pcl6d
