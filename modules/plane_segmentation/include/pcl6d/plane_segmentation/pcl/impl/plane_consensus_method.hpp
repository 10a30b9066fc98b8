// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/require.h>
#include <pcl6d/plane_segmentation/pcl/plane_consensus_method.h>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointT>
bool
PlaneConsensusMethod<PointT>::computeModel(int)
{
  PlaneConsensusOptions options = options_;
  options.max_distance = this->threshold_;
  options.probability = this->probability_;
  require(this->max_iterations_ >= 1, "iterations", this->max_iterations_, ">= 1");
  options.max_iterations = static_cast<std::size_t>(this->max_iterations_);
  result_ = findPlaneConsensus(pack_(), options);
  this->iterations_ = static_cast<int>(result_.draws);
  this->inliers_.clear();
  this->model_.clear();
  this->model_coefficients_.resize(0);
  if (result_.status != Status::kOk)
    return false;
  if (result_.distance(viewpoint_) < 0) {
    result_.normal = -result_.normal;
    result_.offset = -result_.offset;
  }
  this->inliers_.reserve(result_.inliers.size());
  for (const auto place : result_.inliers)
    this->inliers_.push_back((*indices_)[place]);
  for (const auto place : result_.sample)
    this->model_.push_back((*indices_)[place]);
  // The offset is recomputed for the normal in single floats: together they fit at the
  // points.
  Eigen::Vector4f plane = Eigen::Vector4f::Zero();
  double offset = 0;
  for (int axis = 0; axis < 3; ++axis) {
    plane[axis] = static_cast<float>(result_.normal[axis]);
    offset += static_cast<double>(plane[axis]) * result_.centre[axis];
  }
  plane[3] = static_cast<float>(-offset);
  this->model_coefficients_ = plane;
  return true;
}

} // namespace pcl6d
