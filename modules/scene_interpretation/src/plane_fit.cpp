// SPDX-License-Identifier: BSD-3-Clause
#include "plane_fit.h"

#include <pcl6d/common/decompositions.h>
#include <pcl6d/common/portable_math.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl6d::scene_interpretation {

FittedPlane
fitted(const PlaneSegment& segment, const Points& points)
{
  FittedPlane fit;
  fit.normal = segment.plane.normal;
  fit.area = segment.plane.area;
  fit.points = static_cast<double>(segment.points.size());
  for (const auto i : segment.points)
    fit.centroid += points[i].cast<double>() / fit.points;
  for (const auto i : segment.points) {
    const Eigen::Vector3d p = points[i].cast<double>() - fit.centroid;
    fit.scatter += p * p.transpose();
  }
  return fit;
}

bool
fitNormal(const RefinementOptions& options, FittedPlane& fit)
{
  const auto eigen = symmetricEigen<3>(fit.scatter);
  const Eigen::Vector3d& lambda = eigen.values;
  if (fit.points < 3 || !(lambda(1) > 1e-9 * lambda(2)))
    return false;
  const Eigen::Vector3d before = fit.normal;
  fit.normal = eigen.vectors.col(0);
  if (fit.normal.dot(before) < 0)
    fit.normal = -fit.normal;
  constexpr double kPatch = 1.0;           // [m^2] patch with one independent map error
  constexpr double kLeastVariance = 1e-20; // [rad^2] of planes without any error
  const double noise = std::max(lambda(0), 0.0) / std::max(fit.points - 3, 1.0);
  const double patches = std::max(fit.area / kPatch, 1.0);
  const double bias = options.map_position_error * options.map_position_error / patches;
  for (const int k : {1, 2}) {
    const Eigen::Vector3d axis = eigen.vectors.col(k);
    const double spread = lambda(k) / fit.points; // [m^2] mean square
    const double variance = noise / lambda(k) + bias / spread;
    fit.information += axis * axis.transpose() / std::max(variance, kLeastVariance);
    fit.covariance += (variance + options.map_angle_error * options.map_angle_error) *
                      axis * axis.transpose();
  }
  return true;
}

Turn
turnTo(const FittedPlane& plane, const Eigen::Vector3d& exact)
{
  const Eigen::Vector3d axis = plane.normal.cross(exact);
  const Eigen::Vector3d towards = axis.cross(plane.normal);
  if (towards.norm() <= 0)
    return {};
  const Eigen::Vector3d d = towards.normalized();
  return {portableAtan2(axis.norm(), plane.normal.dot(exact)),
          std::sqrt(d.dot(plane.covariance * d))};
}

} // namespace pcl6d::scene_interpretation
