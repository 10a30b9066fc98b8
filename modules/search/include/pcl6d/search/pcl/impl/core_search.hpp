// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/search/pcl/core_search.h>

#include <pcl/types.h>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT, typename Core, typename Base>
SetInputCloudResult<Base>
CoreSearch<PointT, Core, Base>::setInputCloud(const PointCloudConstPtr& cloud,
                                              const pcl::IndicesConstPtr& indices)
{
  if (!cloud)
    throw BadArgument(this->name_ + ": the input cloud is null");
  if (indices)
    requireIndices(*indices, cloud->size());
  Points points = indices ? toPoints(*cloud, *indices) : toPoints(*cloud);
  origin_ = localOrigin(points);
  for (auto& p : points)
    p -= origin_;
  core_ = build(points);
  this->input_ = cloud;
  this->indices_ = indices;
  return static_cast<SetInputCloudResult<Base>>(true);
}

template <typename PointT, typename Core, typename Base>
int
CoreSearch<PointT, Core, Base>::nearestKSearch(
    const PointT& point,
    int k,
    pcl::Indices& k_indices,
    std::vector<float>& k_sqr_distances) const
{
  const Eigen::Vector3f query = local(point);
  if (k == 1)
    return toPcl(findNearest(query, std::numeric_limits<float>::infinity()),
                 k_indices,
                 k_sqr_distances);
  const int count = toPcl(
      k > 0 ? findK(query, k) : std::vector<Neighbour>(), k_indices, k_sqr_distances);
  return count == 0 && k > 0 ? toPcl(Neighbour(), k_indices, k_sqr_distances) : count;
}

template <typename PointT, typename Core, typename Base>
int
CoreSearch<PointT, Core, Base>::radiusSearch(const PointT& point,
                                             double radius,
                                             pcl::Indices& k_indices,
                                             std::vector<float>& k_sqr_distances,
                                             unsigned int max_nn) const
{
  const auto found = core_->withinRadius(local(point), squaredLimit(radius), max_nn);
  return toPcl(found, k_indices, k_sqr_distances);
}

template <typename PointT, typename Core, typename Base>
Neighbour
CoreSearch<PointT, Core, Base>::nearest(const PointT& point, double max_distance) const
{
  return inCloud(findNearest(local(point), squaredLimit(max_distance)));
}

template <typename PointT, typename Core, typename Base>
int
CoreSearch<PointT, Core, Base>::toPcl(const Neighbour& found,
                                      pcl::Indices& indices,
                                      std::vector<float>& sqr_distances) const
{
  // PCL's own code (Registration::getFitnessScore) reads the first entry unchecked,
  // even without a neighbour.
  const bool none = found.index < 0;
  indices.assign(1, inCloud(found).index);
  sqr_distances.assign(
      1, none ? std::numeric_limits<float>::infinity() : found.distance_sq);
  return none ? 0 : 1;
}

template <typename PointT, typename Core, typename Base>
int
CoreSearch<PointT, Core, Base>::toPcl(const std::vector<Neighbour>& found,
                                      pcl::Indices& indices,
                                      std::vector<float>& sqr_distances) const
{
  indices.resize(found.size());
  sqr_distances.resize(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    indices[i] = inCloud(found[i]).index;
    sqr_distances[i] = found[i].distance_sq;
  }
  return static_cast<int>(found.size());
}

} // namespace pcl6d
