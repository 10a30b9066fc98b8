// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/filters/pcl/impl/average_fields.hpp>
#include <pcl6d/filters/pcl/octree_reduction.h>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
OctreeReduction<PointT>::OctreeReduction()
{
  this->filter_name_ = "OctreeReduction";
}

template <typename PointT>
void
OctreeReduction<PointT>::applyFilter(PointCloud& output)
{
  options_.validate();
  const auto& input = *this->input_;
  const pcl::Indices& chosen = *this->indices_;
  requireIndices(chosen, input.size());
  const auto pointOf = [&](pcl::index_t i) -> const PointT& {
    return input[chosen[i]];
  };
  const Points points = toPoints(input, chosen);
  const VoxelGroups groups(points, options_.voxel);
  output.clear();
  output.header = input.header;
  output.is_dense = true;
  if (options_.method == ReductionMethod::kRandom) {
    for (const auto i : groups.chooseRandom(options_.points_per_voxel, options_.seed))
      output.push_back(pointOf(i));
    return;
  }
  output.resize(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const IndexRange members = groups.indices(g);
    PointT& point = output[g] = pointOf(*members.begin());
    if (options_.method == ReductionMethod::kMean)
      averageMembers(points, members, pointOf, point);
    else
      point.getVector3fMap() = voxelCentre(groups.key(g), options_.voxel);
  }
}

} // namespace pcl6d
