// SPDX-License-Identifier: BSD-3-Clause
#include "proposals/footprint_box.h"

#include <pcl6d/common/polygon.h>

#include <algorithm>
#include <limits>

namespace pcl6d::object_localization {

namespace {
/** Across a direction, level. */
Eigen::Vector3d
across(const Eigen::Vector3d& up, const Eigen::Vector3d& way)
{
  return up.cross(way).normalized();
}

/** \return the extent of corners along a direction */
Eigen::AlignedBox1d
along(const std::vector<Eigen::Vector3d>& corners, const Eigen::Vector3d& way)
{
  Eigen::AlignedBox1d extent;
  for (const auto& corner : corners)
    extent.extend(Eigen::Matrix<double, 1, 1>(corner.dot(way)));
  return extent;
}

/** \return the direction of the longer side of the smallest rectangle around a hull;
 * one side lies along an edge of the hull (Freeman and Shapira 1975) */
Eigen::Vector3d
longerSide(const std::vector<Eigen::Vector3d>& hull, const Eigen::Vector3d& up)
{
  Eigen::Vector3d best = up.unitOrthogonal();
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector3d edge = hull[(i + 1) % hull.size()] - hull[i];
    if (!(edge.squaredNorm() > 0))
      continue;
    const Eigen::Vector3d x = edge.normalized(), y = across(up, x);
    const double length = along(hull, x).sizes()[0], width = along(hull, y).sizes()[0];
    if (length * width < least) {
      least = length * width;
      best = length >= width ? x : y;
    }
  }
  return best;
}
} // namespace

FootprintBox
footprintBox(const Points& points, const Eigen::Vector3d& up, double height)
{
  std::vector<Eigen::Vector3d> plan;
  double top = height;
  for (const auto& point : points) {
    const Eigen::Vector3d p = point.cast<double>();
    top = std::max(top, up.dot(p));
    plan.push_back(p - (up.dot(p) - height) * up);
  }
  std::vector<Eigen::Vector3d> hull = convexHull(plan, up);
  if (hull.empty())
    hull = plan;
  const Eigen::Vector3d x = longerSide(hull, up), y = across(up, x);
  const auto x_extent = along(hull, x), y_extent = along(hull, y);
  FootprintBox box;
  box.T_scene_box = Eigen::Isometry3d::Identity();
  box.T_scene_box.linear() << x, y, up;
  box.T_scene_box.translation() =
      x_extent.center()[0] * x + y_extent.center()[0] * y + height * up;
  box.size = {x_extent.sizes()[0], y_extent.sizes()[0], top - height};
  return box;
}

} // namespace pcl6d::object_localization
