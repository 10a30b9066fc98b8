// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/pcl/scan_line_median.h>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
ScanLineMedian<PointT>::ScanLineMedian()
{
  this->filter_name_ = "ScanLineMedian";
}

template <typename PointT>
void
ScanLineMedian<PointT>::applyFilter(PointCloud& output)
{
  const std::size_t line_length = this->checkedLineLength();
  const Points points = toPoints(*this->input_);
  const Points filtered = medianAlongLines(points, line_length, options_);
  output = *this->input_;
  for (const auto i : *this->indices_)
    if (points[i].allFinite())
      output[i].getVector3fMap() = filtered[i];
}

} // namespace pcl6d
