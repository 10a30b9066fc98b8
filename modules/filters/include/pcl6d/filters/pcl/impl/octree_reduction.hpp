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
  Points points(chosen.size()); // where toPoints() would ask for room at each point
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointT& p = input[chosen[i]];
    points[i] = {p.x, p.y, p.z};
  }
  const auto begin = [&] {
    output.clear();
    output.header = input.header;
    output.is_dense = true;
  };
  if (options_.method == ReductionMethod::kMean && hasOnlyCoordinates<PointT>()) {
    const Points means = reducePoints(points, options_);
    begin();
    output.resize(means.size());
    for (std::size_t i = 0; i < means.size(); ++i)
      output[i].getVector3fMap() = means[i];
    return;
  }
  const VoxelGroups groups(points, options_.voxel);
  begin();
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
