// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/filters/pcl/approximate_voxel_grid.h>
#include <pcl6d/filters/pcl/impl/average_fields.hpp>
#include <pcl6d/filters/pcl/impl/chosen_points.hpp>

#include <cstdint>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
ApproximateVoxelGrid<PointT>::ApproximateVoxelGrid()
{
  this->filter_name_ = "ApproximateVoxelGrid";
}

template <typename PointT>
void
ApproximateVoxelGrid<PointT>::applyFilter(PointCloud& output)
{
  const ChosenPoints<PointT> chosen(*this->input_, *this->indices_);
  const LeafOrder order(chosen.view(), LeafCells(chosen.view(), leaf_));
  averageCells(
      *this->input_, *this->indices_, chosen.view(), order, downsample_all_, output);
  output.is_dense = true;
  output.width = static_cast<std::uint32_t>(output.size());
  output.height = 1;
}

} // namespace pcl6d
