// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_bend.h"

#include <pcl6d/common/decompositions.h>

#include <Eigen/Geometry>

#include <cmath>

namespace pcl6d::plane_segmentation {

namespace {
constexpr double kExplained = 0.5; // of the squared distances to the plane
constexpr double kLeastSlope =
    0.025; // [rad] at two standard deviations from the middle

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
} // namespace

bool
isBent(const PlaneCloud& cloud, const PlanePart& part)
{
  const PlaneFit& plane = part.plane;
  const Eigen::Vector3d u = plane.normal.unitOrthogonal();
  const Eigen::Vector3d v = plane.normal.cross(u);
  Matrix6d normal_matrix = Matrix6d::Zero();
  Vector6d right_side = Vector6d::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  double squares = 0;
  for (const auto i : part.points) {
    const Eigen::Vector3d p = cloud.points()[i].cast<double>() - plane.centre;
    const double x = u.dot(p), y = v.dot(p), distance = plane.normal.dot(p);
    const Vector6d terms = (Vector6d() << 1, x, y, x * x, x * y, y * y).finished();
    normal_matrix.noalias() += terms * terms.transpose();
    right_side += distance * terms;
    spread += Eigen::Vector2d(x, y) * Eigen::RowVector2d(x, y);
    squares += distance * distance;
  }
  const Vector6d surface = solveSymmetric(normal_matrix, right_side);
  const double explained = surface.dot(right_side);
  if (!(explained > kExplained * squares))
    return false;
  Eigen::Matrix2d curvature;
  curvature << 2 * surface[3], surface[4], surface[4], 2 * surface[5];
  const auto eigen = symmetricEigen<2>(curvature);
  const int most = std::abs(eigen.values[0]) > std::abs(eigen.values[1]) ? 0 : 1;
  const Eigen::Vector2d across = eigen.vectors.col(most);
  const double reach = 2 * std::sqrt(across.dot(spread * across) /
                                     static_cast<double>(part.points.size()));
  return std::abs(eigen.values[most]) * reach > kLeastSlope;
}

} // namespace pcl6d::plane_segmentation
