// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/global_registration/pcl/global_registration.h>

#include <utility>

namespace PCL6D_EXPORTS pcl6d {

template <typename PointSource, typename PointTarget, typename Scalar>
CoarseEstimate
GlobalRegistration<PointSource, PointTarget, Scalar>::search(
    const Points& target,
    const Points& source,
    const Eigen::Isometry3d& /*guess*/) const
{
  PairPlacement placed = placer_.place(target, source);
  found_ = std::move(placed.result);
  CoarseEstimate estimate;
  if (found_.candidates.empty() || found_.answer == PlaceAnswer::kNone)
    return estimate;
  estimate.status =
      found_.answer == PlaceAnswer::kUnique ? Status::kOk : Status::kRankDeficient;
  estimate.T_target_source = placed.T_target_source;
  estimate.score = found_.candidates.front().score;
  estimate.second_score = found_.ambiguity() * estimate.score;
  return estimate;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void
GlobalRegistration<PointSource, PointTarget, Scalar>::computeTransformation(
    PointCloudSource& output,
    const Matrix4& guess)
{
  found_ = PlaceResult();
  Base::computeTransformation(output, guess);
  const Eigen::Vector3d to =
      this->target_->sensor_origin_.template head<3>().template cast<double>();
  const Eigen::Vector3d from =
      this->input_->sensor_origin_.template head<3>().template cast<double>();
  for (auto& one : found_.candidates) {
    one.T_first_second.translate(-from);
    one.T_first_second.pretranslate(to);
  }
}

} // namespace pcl6d
