// SPDX-License-Identifier: BSD-3-Clause
#include "point_spread.h"
#include "top_view_points.h"

#include <algorithm>

namespace pcl6d {

namespace {
std::vector<float>
heightsOf(const TopViewScene& scene, const std::vector<std::size_t>& indices)
{
  std::vector<float> heights;
  heights.reserve(indices.size());
  for (const auto i : indices)
    heights.push_back(scene.points[i].z());
  return heights;
}
} // namespace

DrawnPoints
drawnPoints(const TopViewScene& scene,
            const ShownPoints& shown,
            const TopViewOptions& options,
            TopViewLayout& layout)
{
  DrawnPoints drawn;
  const auto indices = thinned(shown.indices, options.max_points);
  PointPaint paint = paintPoints(
      scene, indices, {options.colour, options.colour_map, options.background});
  layout.lowest_colour = paint.scale.lowest;
  layout.highest_colour = paint.scale.highest;
  drawn.scale = std::move(paint.scale);
  if (indices.empty())
    return drawn;
  const auto heights = heightsOf(scene, indices);
  const auto ends = std::minmax_element(heights.begin(), heights.end());
  const float lowest = *ends.first;
  const float size = std::max(*ends.second - lowest, 1e-3F);
  drawn.pixels.reserve(indices.size());
  drawn.colours.reserve(indices.size());
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const Eigen::Vector3f& p = scene.points[indices[k]];
    const Eigen::Vector2d pixel = layout.toPixel(p.head<2>().cast<double>());
    if (!layout.map.contains(pixel))
      continue;
    drawn.pixels.emplace_back(static_cast<float>(pixel.x()),
                              static_cast<float>(pixel.y()),
                              (p.z() - lowest) / size);
    drawn.colours.push_back(paint.colours[k]);
  }
  drawn.size = options.point_size.value_or(std::clamp(
      1.4 * pixelSpacing(drawn.pixels, layout.width, layout.height), 1.5, 6.0));
  layout.points_drawn = drawn.pixels.size();
  return drawn;
}

} // namespace pcl6d
