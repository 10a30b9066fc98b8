// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/filters/octree_reduction.h>

#include <pcl/common/centroid.h>

namespace pcl6d {

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
  const Points points = toPoints(input, chosen);
  const VoxelGroups groups(points, options_.voxel);
  output.clear();
  output.header = input.header;
  output.is_dense = true;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (options_.method == ReductionMethod::kRandom) {
      for (const auto i :
           groups.chooseRandom(g, options_.points_per_voxel, options_.seed))
        output.push_back(input[chosen[i]]);
      continue;
    }
    const pcl::Indices members = groups.indices(g);
    PointT point = input[chosen[members.front()]];
    if (options_.method == ReductionMethod::kCentre) {
      point.getVector3fMap() = voxelCentre(groups.key(g), options_.voxel);
    }
    else {
      pcl::CentroidPoint<PointT> mean;
      for (const auto i : members)
        mean.add(input[chosen[i]]);
      mean.get(point);
      // PCL sums in float, which drifts out of the voxel far from the origin.
      point.getVector3fMap() = meanOf(points, members);
    }
    output.push_back(point);
  }
}

} // namespace pcl6d
