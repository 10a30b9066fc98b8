// SPDX-License-Identifier: BSD-3-Clause
#include "plane_prism.h"

#include <algorithm>
#include <cmath>

namespace pcl6d {

PlanePrism::PlanePrism(const PlaneSegment& segment)
: side_(segment.seen_from)
, offset_(segment.plane.normal.dot(side_) < 0 ? -segment.plane.offset
                                              : segment.plane.offset)
{
  const auto& hull = segment.plane.hull;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector3d edge = hull[(i + 1) % hull.size()] - hull[i];
    if (!(edge.squaredNorm() > 0))
      continue;
    const Eigen::Vector3d out = edge.cross(segment.plane.normal).normalized();
    edges_.emplace_back(out.x(), out.y(), out.z(), -out.dot(hull[i]));
  }
}

bool
PlanePrism::covers(const Eigen::Vector3f& point, double margin) const
{
  const Eigen::Vector4d place = point.cast<double>().homogeneous();
  return std::all_of(edges_.begin(), edges_.end(), [&](const Eigen::Vector4d& edge) {
    return edge.dot(place) <= margin;
  });
}

double
widthOf(const std::vector<Eigen::Vector3d>& hull, const Eigen::Vector3d& up)
{
  double width_sq = 0;
  for (const auto& a : hull)
    for (const auto& b : hull)
      width_sq = std::max(width_sq, (a - b).cross(up).squaredNorm());
  return std::sqrt(width_sq);
}

double
heightOf(const std::vector<Eigen::Vector3d>& hull, const Eigen::Vector3d& up)
{
  double low = 0, high = 0;
  for (const auto& corner : hull) {
    const double height = up.dot(corner - hull[0]);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return high - low;
}

Eigen::Vector3d
middleOf(const std::vector<Eigen::Vector3d>& hull)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& corner : hull)
    sum += corner;
  return sum / static_cast<double>(std::max<std::size_t>(hull.size(), 1));
}

} // namespace pcl6d
