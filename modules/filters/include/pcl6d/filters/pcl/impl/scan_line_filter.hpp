// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/filters/pcl/scan_line_filter.h>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
std::size_t
ScanLineFilter<PointT>::checkedLineLength() const
{
  const auto& input = *this->input_;
  requireIndices(*this->indices_, input.size());
  return lineLengthOf(input.width, input.height, input.size(), line_length_);
}

} // namespace pcl6d
