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

double
widthOf(const std::vector<Eigen::Vector3d>& points)
{
  const auto count = static_cast<double>(points.size());
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points)
    middle += p / count;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points)
    scatter += (p - middle) * (p - middle).transpose() / count;
  return evenWidth(symmetricEigenvalues<3>(scatter)(1));
}

double
arcWidthOf(const std::vector<Eigen::Vector3d>& directions)
{
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& d : directions)
    scatter += d * d.transpose() / static_cast<double>(directions.size());
  return std::min(widthOf(directions), evenWidth(symmetricEigenvalues<3>(scatter)(0)));
}

double
seenWidthOf(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& from)
{
  Eigen::Vector3d ray = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points)
    ray += p - from;
  ray.normalize();
  std::vector<Eigen::Vector3d> seen;
  seen.reserve(points.size());
  for (const Eigen::Vector3d& p : points)
    seen.push_back(p - ray.dot(p - from) * ray);
  return widthOf(seen);
}

} // namespace pcl6d::moving_objects
