// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/search/core_search.h>

#include <Eigen/Geometry>

#include <cmath>

namespace pcl6d {

Eigen::Vector3f
localOrigin(const Points& points)
{
  constexpr double kNear = 8192, kUnit = 1024; // [m]
  Eigen::AlignedBox3d box;
  for (const auto& p : points)
    if (p.allFinite())
      box.extend(p.cast<double>());
  if (box.isEmpty())
    return Eigen::Vector3f::Zero();
  const Eigen::Vector3d centre = box.center();
  if (!(centre.cwiseAbs().maxCoeff() > kNear) || box.diagonal().maxCoeff() > kNear)
    return Eigen::Vector3f::Zero();
  return (kUnit * (centre / kUnit).array().round()).cast<float>();
}

} // namespace pcl6d
