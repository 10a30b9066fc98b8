// SPDX-License-Identifier: BSD-3-Clause
#include "annotations.h"
#include "top_view_layout.h"

#include <pcl6d/common/error.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl6d {

namespace {
/** Evenly spaced members, enough for a quantile. */
std::vector<float>
sampleOf(const Points& points, int axis)
{
  constexpr std::size_t kEnough = 500000;
  const std::size_t step = points.size() / kEnough + 1;
  std::vector<float> values;
  values.reserve(points.size() / step + 1);
  for (std::size_t i = 0; i < points.size(); i += step)
    values.push_back(points[i][axis]);
  return values;
}

/** The extent of the points, but not of single ones that lie far outside. */
Eigen::AlignedBox2d
mapExtent(const Points& points)
{
  Eigen::AlignedBox2d all, core;
  for (const auto& p : points)
    all.extend(p.head<2>().cast<double>());
  Eigen::Vector2d low, high;
  for (int axis = 0; axis < 2; ++axis) {
    const auto values = sampleOf(points, axis);
    low[axis] = quantile(values, 0.002);
    high[axis] = quantile(values, 0.998);
  }
  constexpr double kReach = 0.15; // of the core's size
  const Eigen::Vector2d reach = kReach * (high - low);
  return all.intersection(Eigen::AlignedBox2d(low - reach, high + reach));
}

/** Where poses and overlay are. */
std::vector<Eigen::Vector2d>
placesOf(const TopViewScene& scene)
{
  std::vector<Eigen::Vector2d> places;
  const auto add = [&](const Eigen::Vector3d& place) {
    if (place.allFinite())
      places.emplace_back(place.head<2>());
  };
  for (const auto* trajectory : {&scene.trajectory, &scene.initial})
    for (const auto& pose : trajectory->poses)
      add(pose.translation());
  for (const auto& mark : scene.overlay.marks)
    add(mark.place);
  for (const auto& line : scene.overlay.lines)
    for (const auto& place : line.points)
      add(place);
  return places;
}

Eigen::AlignedBox2d
sceneExtent(const Points& points, const TopViewScene& scene)
{
  Eigen::AlignedBox2d box;
  if (!points.empty())
    box = mapExtent(points);
  for (const auto& place : placesOf(scene))
    box.extend(place);
  constexpr double kSmallest = 1.0; // [m] so that equal points are drawn, too
  const Eigen::Vector2d lacking =
      0.5 * (Eigen::Vector2d::Constant(kSmallest) - box.sizes()).cwiseMax(0.0);
  const Eigen::Vector2d rim = 0.003 * box.sizes(); // room for points at the edge
  box.min() -= lacking + rim;
  box.max() += lacking + rim;
  return box;
}

void
placeScaleBar(TopViewLayout& layout, double margin)
{
  const double longest = 0.2 * (layout.map.right - layout.map.left);
  layout.scale_bar_metres = roundDown(longest * layout.metres_per_pixel);
  const double row = layout.height - margin - 0.6 * layout.text_size;
  layout.scale_bar_begin = {margin + 0.5 * layout.text_size, row};
  layout.scale_bar_end = layout.scale_bar_begin;
  layout.scale_bar_end.x() += layout.scale_bar_metres / layout.metres_per_pixel;
}
} // namespace

double
roundDown(double metres)
{
  const double power = std::pow(10.0, std::floor(std::log10(metres)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= metres)
      return digit * power;
  return power;
}

float
quantile(std::vector<float> values, double share)
{
  const auto rank = static_cast<std::ptrdiff_t>(
      std::lround(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

PointsToDraw
pointsToDraw(const TopViewScene& scene, const TopViewOptions& options)
{
  PointsToDraw drawn;
  drawn.shown = shownPoints(scene.points, scene.trajectory, options.cut);
  const auto& indices = drawn.shown.indices;
  if (indices.empty() && (!scene.points.empty() || placesOf(scene).empty()))
    throw BadArgument(options.cut.slice ? "the slice has no points to draw"
                                        : "the map has no points to draw");
  drawn.points.reserve(indices.size());
  for (const auto i : indices)
    drawn.points.push_back(scene.points[i]);
  return drawn;
}

Eigen::AlignedBox2d
areaOf(const TopViewScene& scene, const TopViewOptions& options)
{
  return sceneExtent(pointsToDraw(scene, options).points, scene);
}

TopViewLayout
layOut(const Points& points, const TopViewScene& scene, const TopViewOptions& options)
{
  const Eigen::AlignedBox2d box =
      options.area ? *options.area : sceneExtent(points, scene);
  const double margin = options.margin;
  TopViewLayout layout;
  layout.width = options.width;
  layout.area = box;
  layout.text_size = textSizeFor(options.width);
  const bool has_top_line = !options.title.empty() || !scene.trajectory.poses.empty() ||
                            !scene.initial.poses.empty() || !scene.overlay.keys.empty();
  layout.map.left = margin;
  layout.map.right = options.width - margin;
  layout.map.top = margin + (has_top_line ? 2.2 * layout.text_size : 0);
  const double below = margin + 3.2 * layout.text_size; // scale bar, colour bar
  const double map_width = layout.map.right - layout.map.left;
  const double shape =
      std::clamp(box.sizes().y() / box.sizes().x(), 0.3, 1.25); // no towers, no stripes
  layout.height = options.height.value_or(
      static_cast<int>(std::lround(layout.map.top + shape * map_width + below)));
  layout.map.bottom = layout.height - below;
  layout.centre = box.center();
  layout.metres_per_pixel =
      std::max(box.sizes().x() / map_width,
               box.sizes().y() / (layout.map.bottom - layout.map.top));
  placeScaleBar(layout, margin);
  return layout;
}

} // namespace pcl6d
