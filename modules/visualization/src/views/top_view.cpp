// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/annotations.h"
#include "drawing/picture_size.h"
#include "drawing/point_paint.h"
#include "drawing/point_spread.h"
#include "drawing/round_numbers.h"
#include "views/top_view_area.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/visualization/top_view.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl6d {
using namespace visualization;

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

/** Extent of the points without isolated far points. */
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

std::vector<float>
heightsOf(const TopViewScene& scene, const std::vector<std::size_t>& indices)
{
  std::vector<float> heights;
  heights.reserve(indices.size());
  for (const auto i : indices)
    heights.push_back(scene.points[i].z());
  return heights;
}
/** \brief The points of a scene that remain after the cut. */
struct PointsToDraw {
  ShownPoints shown;
  Points points; ///< those of shown
};

/** \throws BadArgument the scene is empty (no point, pose or overlay), or the cut
 * leaves no point */
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

/** \brief Chooses map area, scale and scale bar. \param[in] points finite, at least one
 */
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
                            !scene.initial.poses.empty() ||
                            !scene.overlay.keys.empty() || !scene.moving.empty();
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

/** \brief The map's points on the picture. */
struct DrawnPoints {
  std::vector<Eigen::Vector3f> pixels; ///< column, row, layer in [0, 1] by height
  std::vector<Colour> colours;
  ColourScale scale;
  double size = 1; ///< [px]
};

/** \brief Places, thins and colours the shown points.
 * \param[in,out] layout gets the range of the colours and the number of points */
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

/** \brief Adds the dynamic points, over the other points. \param[in] size of dynamic
 * points [px] */
void
addMoving(const TopViewScene& scene,
          const TopViewOptions& options,
          const TopViewLayout& layout,
          double size,
          PixelScene& canvas)
{
  constexpr float kOver = 1.1F;     // static points have layers up to 1
  constexpr double kNoticeable = 3; // [px]
  const auto shown = shownPoints(scene.moving, scene.trajectory, options.cut).indices;
  std::vector<Eigen::Vector3f> pixels;
  for (const auto i : thinned(shown, options.max_points)) {
    const Eigen::Vector2d pixel =
        layout.toPixel(scene.moving[i].head<2>().cast<double>());
    if (layout.map.contains(pixel))
      pixels.emplace_back(
          static_cast<float>(pixel.x()), static_cast<float>(pixel.y()), kOver);
  }
  const Colour colour = themeOf(options.background).moved;
  canvas.addPoints(
      pixels, std::vector<Colour>(pixels.size(), colour), std::max(size, kNoticeable));
}
} // namespace

void
TopViewOptions::validate() const
{
  requirePictureSize("width", width);
  if (height)
    requirePictureSize("height", *height);
  const int shorter = std::min(width, height.value_or(width));
  require(margin >= 0 && margin <= shorter / 8, "margin", margin, "0 to an eighth");
  if (point_size)
    require(
        *point_size > 0 && *point_size <= 100, "point_size", *point_size, "0 to 100");
  require(max_points > 0, "max_points", max_points, "> 0");
  require(!area || (area->sizes().minCoeff() > 0 && area->sizes().allFinite()),
          "area",
          "empty",
          "a box of more than 0 m");
  require(shading >= 0 && shading <= 5, "shading", shading, "0 to 5");
  cut.validate();
}

TopView::TopView(const TopViewOptions& options) : options_(options)
{
  options_.validate();
}

TopViewPicture
TopView::draw(const TopViewScene& scene) const
{
  scene.validate(options_.colour);
  const auto [shown, points] = pointsToDraw(scene, options_);
  TopViewPicture picture;
  TopViewLayout& layout = picture.layout;
  layout = layOut(points, scene, options_);
  layout.ceiling_hidden = shown.ceiling_hidden;
  const DrawnPoints drawn = drawnPoints(scene, shown, options_, layout);
  PixelScene canvas(
      layout.width, layout.height, themeOf(options_.background).background);
  canvas.setShading(options_.shading);
  canvas.addPoints(drawn.pixels, drawn.colours, drawn.size);
  if (!scene.moving.empty())
    addMoving(scene, options_, layout, drawn.size, canvas);
  const Annotations::Project project = [&](const Eigen::Vector3d& place) {
    return std::optional<Eigen::Vector2d>(layout.toPixel(place.head<2>()));
  };
  annotate(options_, scene, layout, drawn.scale, project, canvas);
  picture.image = canvas.draw(options_.transparent);
  return picture;
}

TopViewLayout
TopView::write(const std::filesystem::path& path, const TopViewScene& scene) const
{
  const TopViewPicture picture = draw(scene);
  writePng(path, picture.image);
  return picture.layout;
}

Eigen::AlignedBox2d
visualization::areaOf(const TopViewScene& scene, const TopViewOptions& options)
{
  return sceneExtent(pointsToDraw(scene, options).points, scene);
}

} // namespace pcl6d
