// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/pcl/impl/chosen_points.hpp>
#include <pcl6d/filters/pcl/uniform_sampling.h>

#include <pcl/types.h>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
UniformSampling<PointT>::UniformSampling(bool extract_removed_indices)
: pcl::FilterIndices<PointT>(extract_removed_indices)
{
  this->filter_name_ = "UniformSampling";
}

template <typename PointT>
void
UniformSampling<PointT>::applyFilter(pcl::Indices& indices)
{
  const ChosenPoints<PointT> chosen(*this->input_, *this->indices_);
  const CoordinateView& points = chosen.view();
  const auto side = static_cast<float>(radius_);
  const LeafCells cells(points, {side, side, side});
  const LeafOrder order(points, cells);
  const std::vector<bool> is_kept = nearestToCentres(points, cells, order);
  indices.clear();
  this->removed_indices_->clear();
  for (std::size_t i = 0; i < points.size; ++i) {
    const pcl::index_t index = (*this->indices_)[i];
    const bool is_finite = order.ranks()[i] < order.size();
    if (is_finite && is_kept[i] != this->negative_)
      indices.push_back(index);
    else if (this->extract_removed_indices_)
      this->removed_indices_->push_back(index);
  }
}

} // namespace pcl6d
