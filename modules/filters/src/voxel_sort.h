// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/common/voxel_key.h>

#include <pcl/types.h>

#include <optional>
#include <vector>

namespace pcl6d::filters {

/** \brief The finite points of a cloud in the order of their voxels. */
struct VoxelOrder {
  pcl::Indices indices;       ///< of the points; ascending inside a voxel
  std::vector<VoxelKey> keys; ///< of the occupied voxels, ascending
  std::vector<pcl::index_t>
      begin; ///< first member of each voxel in indices, and the end
};

/** \brief Sorts points by voxelKey(), and within a voxel by index, in O(N): keys counted from the
 * corner of the points' bounding box are short, and sorted by their digits, the last digit first.
 * \throws BadArgument a point does not fit into the grid (see voxelKey()) */
VoxelOrder
sortByVoxel(const Points& points, double voxel);

/** \return the means of the voxels' points in the order of sortByVoxel(), without intermediate
 * lists; empty if the points are too many, or the voxels too small, for short keys */
std::optional<Points>
meansByVoxel(const Points& points, double voxel);

} // namespace pcl6d::filters
