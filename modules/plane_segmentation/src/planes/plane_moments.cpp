// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_moments.h"

#include <pcl6d/common/decompositions.h>

#include <algorithm>

namespace pcl6d::plane_segmentation {

void
PlaneMoments::add(const PlaneMoments& other)
{
  const Eigen::Vector3d shift = other.about_ - about_;
  const Eigen::Matrix3d mixed = other.sum_ * shift.transpose();
  count_ += other.count_;
  weight_ += other.weight_;
  sum_ += other.sum_ + other.weight_ * shift;
  squares_ += other.squares_ + mixed + mixed.transpose() +
              other.weight_ * shift * shift.transpose();
}

double
PlaneMoments::meanSquare(const PlaneFit& plane) const
{
  const double shift = plane.distance(mean());
  const double square =
      plane.normal.dot(scatter() * plane.normal) + weight_ * shift * shift;
  return std::max(0.0, square) / static_cast<double>(count_);
}

std::optional<PlaneFit>
PlaneMoments::fit() const
{
  constexpr double kLineTolerance = 1e-9; // of squared spreads (book 7.1.1)
  if (count_ < 3)
    return {};
  const auto eigen = symmetricEigen<3>(scatter());
  const Eigen::Vector3d& spread = eigen.values; // ascending
  if (!(spread[1] > kLineTolerance * spread[2]))
    return {};
  PlaneFit plane;
  plane.normal = eigen.vectors.col(0);
  plane.centre = mean();
  plane.offset = plane.normal.dot(plane.centre);
  plane.mean_square = std::max(0.0, spread[0]) / static_cast<double>(count_);
  return plane;
}

} // namespace pcl6d::plane_segmentation
