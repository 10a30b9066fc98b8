// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/filters/pcl/range_gate.h>
#include <pcl6d/filters/range_statistics.h>

#include <pcl/types.h>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
RangeGate<PointT>::RangeGate(bool extract_removed_indices)
: pcl::FilterIndices<PointT>(extract_removed_indices)
{
  this->filter_name_ = "RangeGate";
}

template <typename PointT>
void
RangeGate<PointT>::setLimits(double min_range, double max_range)
{
  validateRangeLimits(min_range, max_range);
  min_range_ = min_range;
  max_range_ = max_range;
}

template <typename PointT>
void
RangeGate<PointT>::applyFilter(pcl::Indices& indices)
{
  requireIndices(*this->indices_, this->input_->size());
  indices.clear();
  this->removed_indices_->clear();
  for (const auto index : *this->indices_) {
    const Eigen::Vector3f p = (*this->input_)[index].getVector3fMap();
    if (p.allFinite() && isWithinRange(p, min_range_, max_range_) != this->negative_)
      indices.push_back(index);
    else if (this->extract_removed_indices_)
      this->removed_indices_->push_back(index);
  }
}

} // namespace pcl6d
