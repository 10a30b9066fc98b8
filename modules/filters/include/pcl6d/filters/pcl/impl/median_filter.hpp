// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/filters/pcl/impl/chosen_points.hpp>
#include <pcl6d/filters/pcl/median_filter.h>

#include <cmath>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
MedianFilter<PointT>::MedianFilter()
{
  this->filter_name_ = "MedianFilter";
}

template <typename PointT>
void
MedianFilter<PointT>::applyFilter(PointCloud& output)
{
  const auto& input = *this->input_;
  require(input.empty() || input.isOrganized(),
          "height",
          input.height,
          "above 1: the cloud is not organized");
  requireIndices(*this->indices_, input.size());
  const std::vector<float> depths = medianDepths(viewOf(input), input.width, options_);
  output = input;
  for (const auto i : *this->indices_)
    output[i].z = depths[i];
}

} // namespace pcl6d
