// SPDX-License-Identifier: BSD-3-Clause
#include "render/film_points.h"

#include <algorithm>

namespace pcl6d::app {

std::vector<std::size_t>
chosenPoints(const Points& points,
             const Trajectory& path,
             const HeightCut& cut,
             std::size_t most)
{
  const auto shown = shownPoints(points, path, cut).indices;
  const std::size_t step = (shown.size() + most - 1) / most;
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < shown.size(); i += std::max<std::size_t>(1, step))
    chosen.push_back(shown[i]);
  return chosen;
}

Eigen::Vector3d
middleOf(const Points& points)
{
  Eigen::Vector3d middle;
  std::vector<float> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), values.begin(), [&](const auto& p) {
      return p[axis];
    });
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    middle[axis] = *half;
  }
  return middle;
}

std::array<double, 2>
heightsAlong(const Trajectory& path, const Points& points)
{
  constexpr double kNear = 12; // [m]
  constexpr std::size_t kEnough = 20000, kPoses = 200;
  const std::size_t step = points.size() / kEnough + 1;
  const std::size_t stride = path.poses.size() / kPoses + 1;
  std::vector<float> heights;
  for (std::size_t i = 0; i < points.size(); i += step)
    for (std::size_t k = 0; k < path.poses.size(); k += stride)
      if ((points[i].cast<double>() - path.poses[k].translation()).head<2>().norm() <
          kNear) {
        heights.push_back(points[i].z());
        break;
      }
  if (heights.empty())
    return {0, 1};
  std::sort(heights.begin(), heights.end());
  return {heights[heights.size() / 50],
          heights[heights.size() - 1 - heights.size() / 50]};
}

} // namespace pcl6d::app
