// SPDX-License-Identifier: BSD-3-Clause
#include "coarse/placement_distance.h"

#include <cmath>

namespace pcl6d::registration {

PlacementDistance::PlacementDistance(const Points& points)
{
  if (points.empty())
    return;
  for (const auto& p : points)
    mean_ += p.cast<double>();
  mean_ /= static_cast<double>(points.size());
  for (const auto& p : points) {
    const Eigen::Vector3d d = p.cast<double>() - mean_;
    covariance_ += d * d.transpose();
  }
  covariance_ /= static_cast<double>(points.size());
}

double
PlacementDistance::operator()(const Eigen::Isometry3d& a,
                              const Eigen::Isometry3d& b) const
{
  const Eigen::Matrix3d turn = a.linear() - b.linear();
  return std::sqrt((turn * covariance_ * turn.transpose()).trace() +
                   (a * mean_ - b * mean_).squaredNorm());
}

} // namespace pcl6d::registration
