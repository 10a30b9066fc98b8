// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/filters/octree_reduction.h>

#include <pcl/common/centroid.h>
#include <pcl/type_traits.h>

#include <boost/mpl/size.hpp>

namespace pcl6d {

template <typename PointT>
OctreeReduction<PointT>::OctreeReduction()
{
  this->filter_name_ = "OctreeReduction";
}

/** Sets the fields of a point to the means of those of the members. Does nothing where
 * x, y, z are all that there is: their mean is not computed here. */
template <typename PointT>
void
averageFields(const pcl::PointCloud<PointT>& input,
              const pcl::Indices& chosen,
              const IndexRange& members,
              PointT& point)
{
  if constexpr (boost::mpl::size<typename pcl::traits::fieldList<PointT>::type>::value >
                3) {
    pcl::CentroidPoint<PointT> mean;
    for (const auto i : members)
      mean.add(input[chosen[i]]);
    mean.get(point);
  }
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
  if (options_.method == ReductionMethod::kRandom) {
    for (const auto i : groups.chooseRandom(options_.points_per_voxel, options_.seed))
      output.push_back(input[chosen[i]]);
    return;
  }
  output.resize(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const IndexRange members = groups.indices(g);
    PointT& point = output[g] = input[chosen[*members.begin()]];
    if (options_.method == ReductionMethod::kMean) {
      averageFields(input, chosen, members, point);
      // PCL sums in float, which drifts out of the voxel far from the origin.
      point.getVector3fMap() = meanOf(points, members);
    }
    else {
      point.getVector3fMap() = voxelCentre(groups.key(g), options_.voxel);
    }
  }
}

} // namespace pcl6d
