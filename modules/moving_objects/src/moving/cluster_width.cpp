// SPDX-License-Identifier: BSD-3-Clause
#include "cluster_width.h"

#include <pcl6d/common/decompositions.h>

#include <algorithm>
#include <cmath>

namespace pcl6d::moving_objects {

namespace {
/** The variance of points spread evenly over a width is width^2 / 12. */
double
evenWidth(double variance)
{
  return std::sqrt(12 * std::max(0.0, variance));
}
} // namespace

Eigen::Matrix3d
scatterOf(const std::vector<Eigen::Vector3d>& points)
{
  const auto count = static_cast<double>(points.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points)
    middle += p / count;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points)
    scatter += (p - middle) * (p - middle).transpose() / count;
  return scatter;
}

double
widthOf(const std::vector<Eigen::Vector3d>& points)
{
  return evenWidth(symmetricEigenvalues<3>(scatterOf(points))(1));
}

double
arcWidthOf(const std::vector<Eigen::Vector3d>& directions)
{
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& d : directions)
    scatter += d * d.transpose() / static_cast<double>(directions.size());
  return std::min(widthOf(directions), evenWidth(symmetricEigenvalues<3>(scatter)(0)));
}

Eigen::Vector2d
seenExtentOf(const Eigen::Matrix3d& scatter, const Eigen::Vector3d& direction)
{
  const Eigen::Matrix3d across =
      Eigen::Matrix3d::Identity() - direction * direction.transpose();
  const Eigen::Vector3d variances =
      symmetricEigenvalues<3>(across * scatter * across); // along it: 0
  return {evenWidth(variances(1)), evenWidth(variances(2))};
}

} // namespace pcl6d::moving_objects
