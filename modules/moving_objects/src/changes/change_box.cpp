// SPDX-License-Identifier: BSD-3-Clause
#include "change_box.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/portable_math.h>

#include <limits>

namespace pcl6d::moving_objects {

Eigen::Matrix3d
uprightAxes(const Eigen::Vector3d& up)
{
  Eigen::Matrix3d axes;
  const bool is_flat = std::abs(up.x()) > 0.7; // not along the projected axis
  const Eigen::Vector3d start =
      is_flat ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  axes.col(2) = up;
  axes.col(0) = (start - start.dot(up) * up).normalized();
  axes.col(1) = up.cross(axes.col(0));
  return axes;
}

namespace {
/** \return in plan, the sum of the distances of points from the nearest side of a box */
double
fromSides(const Points& points,
          const Eigen::Matrix3d& axes,
          const Eigen::AlignedBox3d& box)
{
  double sum = 0;
  for (const auto& p : points) {
    const Eigen::Vector3d own = axes.transpose() * p.cast<double>();
    const Eigen::Vector2d sides = (own - box.min()).cwiseMin(box.max() - own).head<2>();
    sum += sides.minCoeff();
  }
  return sum;
}
} // namespace

ChangeBox
boxAbout(const Points& points, const Eigen::Vector3d& up)
{
  constexpr int kTurns = 90; // a box is symmetric after a quarter turn
  const Eigen::Matrix3d upright = uprightAxes(up);
  double least = std::numeric_limits<double>::infinity();
  ChangeBox best;
  for (int k = 0; k < kTurns; ++k) {
    const SinCos turn = portableSinCos(radians(k));
    Eigen::Matrix3d axes = upright;
    axes.col(0) = turn.cos * upright.col(0) + turn.sin * upright.col(1);
    axes.col(1) = turn.cos * upright.col(1) - turn.sin * upright.col(0);
    Eigen::AlignedBox3d box;
    for (const auto& p : points)
      box.extend(axes.transpose() * p.cast<double>());
    const double sum = fromSides(points, axes, box);
    if (sum >= least)
      continue;
    least = sum;
    best.T_world_box.linear() = axes;
    best.T_world_box.translation() = axes * box.center();
    best.size = box.sizes();
  }
  return best;
}

} // namespace pcl6d::moving_objects
