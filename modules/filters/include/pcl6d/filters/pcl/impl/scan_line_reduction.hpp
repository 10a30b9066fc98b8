// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/pcl/impl/average_fields.hpp>
#include <pcl6d/filters/pcl/scan_line_reduction.h>

#include <pcl/types.h>

#include <limits>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
ScanLineReduction<PointT>::ScanLineReduction()
{
  this->filter_name_ = "ScanLineReduction";
}

template <typename PointT>
void
ScanLineReduction<PointT>::setLineStep(int step)
{
  ScanLineReductionOptions changed = options_;
  changed.line_step = step;
  changed.validate();
  options_ = changed;
}

template <typename PointT>
void
ScanLineReduction<PointT>::applyFilter(PointCloud& output)
{
  const auto& input = *this->input_;
  const std::size_t line_length = this->checkedLineLength();
  // Points that are not chosen count in the line like points without an echo.
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Points points(input.size(), Eigen::Vector3f::Constant(nan));
  for (const auto i : *this->indices_)
    points[i] = input[i].getVector3fMap();
  const auto groups = groupAlongLines(points, line_length, options_);
  const auto pointOf = [&](pcl::index_t i) -> const PointT& { return input[i]; };
  output.clear();
  output.is_dense = true;
  output.resize(groups.size());
  pcl::Indices members;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    members.clear();
    for (std::size_t i = groups[g].begin; i < groups[g].end; ++i)
      if (points[i].allFinite())
        members.push_back(static_cast<pcl::index_t>(i));
    output[g] = input[members.front()];
    averageMembers(
        points, {members.data(), members.data() + members.size()}, pointOf, output[g]);
  }
}

} // namespace pcl6d
