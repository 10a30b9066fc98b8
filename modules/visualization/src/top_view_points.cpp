// SPDX-License-Identifier: BSD-3-Clause
#include "colours.h"
#include "point_spread.h"
#include "top_view_layout.h"
#include "top_view_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

void
setColourRange(const TopViewScene& scene,
               const std::vector<float>& heights,
               PointColour colour,
               TopViewLayout& layout)
{
  if (colour == PointColour::kScan) {
    const auto ends = std::minmax_element(scene.scans.begin(), scene.scans.end());
    layout.lowest_colour = *ends.first;
    layout.highest_colour = *ends.second;
    return;
  }
  layout.lowest_colour = quantile(heights, 0.02);
  layout.highest_colour = quantile(heights, 0.98);
}
} // namespace

Colour
pointColour(double share, const TopViewOptions& options)
{
  if (options.colour == PointColour::kScan)
    return orderColour(share);
  return heightColour(options.background == Background::kLight ? 1 - share : share);
}

DrawnPoints
drawnPoints(const TopViewScene& scene,
            const ShownPoints& shown,
            const TopViewOptions& options,
            TopViewLayout& layout)
{
  const auto indices = thinned(shown.indices, options.max_points);
  const auto heights = heightsOf(scene, indices);
  setColourRange(scene, heights, options.colour, layout);
  const auto ends = std::minmax_element(heights.begin(), heights.end());
  const float lowest = *ends.first;
  const float size = std::max(*ends.second - lowest, 1e-3F);
  const double range = std::max(layout.highest_colour - layout.lowest_colour, 1e-9);

  DrawnPoints drawn;
  drawn.pixels.reserve(indices.size());
  drawn.colours.reserve(indices.size());
  for (const auto i : indices) {
    const Eigen::Vector3f& p = scene.points[i];
    const Eigen::Vector2d pixel = layout.toPixel(p.head<2>().cast<double>());
    if (!layout.map.contains(pixel))
      continue;
    drawn.pixels.emplace_back(static_cast<float>(pixel.x()),
                              static_cast<float>(pixel.y()),
                              (p.z() - lowest) / size);
    const double value = options.colour == PointColour::kScan ? scene.scans[i] : p.z();
    drawn.colours.push_back(
        pointColour((value - layout.lowest_colour) / range, options));
  }
  drawn.size = options.point_size.value_or(std::clamp(
      1.2 * pixelSpacing(drawn.pixels, layout.width, layout.height), 1.5, 6.0));
  layout.points_drawn = drawn.pixels.size();
  return drawn;
}

} // namespace pcl6d
