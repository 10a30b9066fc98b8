// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/search/pcl/core_search.h>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
constexpr std::size_t kSample = 1001; ///< points of the sample that
                                      ///< locates the majority

/** \return the order statistic at a place, separately for x, y, z */
Eigen::Vector3f
sortedAt(const Points& points, std::size_t place)
{
  Eigen::Vector3f values;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> of_axis;
    for (const auto& p : points)
      of_axis.push_back(p[axis]);
    const auto at = of_axis.begin() + static_cast<std::ptrdiff_t>(place);
    std::nth_element(of_axis.begin(), at, of_axis.end());
    values[axis] = *at;
  }
  return values;
}
} // namespace

Eigen::Vector3f
localOrigin(const Points& points)
{
  constexpr float kNear = 8192, kUnit = 1024; // [m]
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kSample);
  Points sample;
  for (std::size_t i = 0; i < points.size(); i += stride)
    if (points[i].allFinite())
      sample.push_back(points[i]);
  if (sample.empty())
    return Eigen::Vector3f::Zero();
  const std::size_t last = sample.size() - 1, wild = sample.size() / 10;
  const Eigen::Vector3f middle = sortedAt(sample, last / 2);
  const Eigen::Vector3f extent = sortedAt(sample, last - wild) - sortedAt(sample, wild);
  if (!(middle.cwiseAbs().maxCoeff() > kNear) || extent.maxCoeff() > kNear)
    return Eigen::Vector3f::Zero();
  return kUnit * (middle / kUnit).array().round();
}

} // namespace pcl6d
