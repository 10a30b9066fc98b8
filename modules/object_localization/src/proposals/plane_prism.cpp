// SPDX-License-Identifier: BSD-3-Clause
#include "proposals/plane_prism.h"

#include <algorithm>
#include <cmath>

namespace pcl6d::object_localization {

PlanePrism::PlanePrism(const PlaneSegment& segment)
: side_(segment.seen_from)
, offset_(segment.plane.normal.dot(side_) < 0 ? -segment.plane.offset
                                              : segment.plane.offset)
, hull_(segment.plane)
{}

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

} // namespace pcl6d::object_localization
