// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/search/kd_tree.h>

#include <limits>

namespace pcl6d {

template <typename PointT>
KdTree<PointT>::KdTree(unsigned int num_threads) : num_threads_(num_threads)
{
  this->name_ = "pcl6d::KdTree";
}

template <typename PointT>
void
KdTree<PointT>::setInputCloud(const PointCloudConstPtr& cloud,
                              const pcl::IndicesConstPtr& indices)
{
  if (!cloud)
    throw BadArgument("KdTree: the input cloud is null");
  this->input_ = cloud;
  this->indices_ = indices;
  const Points points = indices ? toPoints(*cloud, *indices) : toPoints(*cloud);
  point_tree_ = std::make_shared<PointTree>(points, num_threads_);
}

template <typename PointT>
int
KdTree<PointT>::nearestKSearch(const PointT& point,
                               int k,
                               pcl::Indices& k_indices,
                               std::vector<float>& k_sqr_distances) const
{
  std::vector<Neighbour> found;
  if (point_tree_ && k > 0)
    found = point_tree_->nearestK(point.getVector3fMap(), k);
  const int count = toPcl(found, k_indices, k_sqr_distances);
  if (count == 0 && k > 0) {
    // PCL's own code (Registration::getFitnessScore) reads the first entry unseen.
    k_indices.assign(1, -1);
    k_sqr_distances.assign(1, std::numeric_limits<float>::infinity());
  }
  return count;
}

template <typename PointT>
int
KdTree<PointT>::radiusSearch(const PointT& point,
                             double radius,
                             pcl::Indices& k_indices,
                             std::vector<float>& k_sqr_distances,
                             unsigned int max_nn) const
{
  std::vector<Neighbour> found;
  if (point_tree_)
    found = point_tree_->withinRadius(
        point.getVector3fMap(), static_cast<float>(radius * radius), max_nn);
  return toPcl(found, k_indices, k_sqr_distances);
}

template <typename PointT>
int
KdTree<PointT>::toPcl(const std::vector<Neighbour>& found,
                      pcl::Indices& indices,
                      std::vector<float>& sqr_distances) const
{
  indices.resize(found.size());
  sqr_distances.resize(found.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    const int index = found[i].index;
    indices[i] = this->indices_ ? (*this->indices_)[index] : index;
    sqr_distances[i] = found[i].distance_sq;
  }
  return static_cast<int>(found.size());
}

} // namespace pcl6d
