// SPDX-License-Identifier: BSD-3-Clause
// The sources of PointTree under another name and without target_clones: a CPU with
// AVX2 would never choose the plain clone by itself.
#include "plain_point_tree.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/interruption.h>
#include <pcl6d/common/parallel.h>
#include <pcl6d/common/simd_clones.h>

namespace plain {
using namespace pcl6d;
}
#undef PCL6D_SIMD_CLONES
#define PCL6D_SIMD_CLONES
#define pcl6d plain
#include "../../modules/search/src/lowest_node.cpp"
#include "../../modules/search/src/median_split.cpp"
#include "../../modules/search/src/point_tree.cpp"
#include "../../modules/search/src/point_tree_nearest_k.cpp"
#include "../../modules/search/src/point_tree_search.cpp"
#undef pcl6d

std::vector<pcl6d::Neighbour>
pcl6d::test::plainSearchAll(const Points& points, const Points& queries)
{
  return searchAll<plain::PointTree, plain::TwoNearest>(points, queries);
}
