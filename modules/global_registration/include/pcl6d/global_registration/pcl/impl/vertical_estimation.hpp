// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require_indices.h>
#include <pcl6d/global_registration/pcl/vertical_estimation.h>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT, typename PointNT>
VerticalEstimate
VerticalEstimation<PointT, PointNT>::compute()
{
  require(this->input_ != nullptr, "input cloud", "null", "set");
  if (!this->initCompute())
    return estimateVertical({}, expected_);
  requireIndices(*this->indices_, this->input_->size());
  VerticalEstimate found;
  if (normals_) {
    require(normals_->size() == this->input_->size(),
            "input normals",
            normals_->size(),
            "one per point");
    Normals normals;
    for (const auto index : *this->indices_)
      normals.emplace_back((*normals_)[index].getNormalVector3fMap());
    found = estimateVertical(normals, expected_);
  }
  else {
    Points points = toPoints(*this->input_, *this->indices_);
    for (auto& p : points)
      p -= this->input_->sensor_origin_.template head<3>();
    found = estimateVerticalOfScan(points, expected_, num_threads_);
  }
  this->deinitCompute();
  return found;
}

} // namespace pcl6d
