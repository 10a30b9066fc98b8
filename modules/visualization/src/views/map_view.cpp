// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/annotations.h"
#include "drawing/picture_size.h"
#include "drawing/point_spread.h"
#include "views/map_splats.h"

#include <pcl6d/common/require.h>
#include <pcl6d/visualization/map_view.h>

#include <algorithm>

namespace pcl6d {
using namespace visualization;

namespace {
constexpr double kShape = 9.0 / 16; // height by width

Points
chosen(const Points& points, const std::vector<std::size_t>& indices)
{
  Points result;
  result.reserve(indices.size());
  for (const auto i : indices)
    result.push_back(points[i]);
  return result;
}
} // namespace

void
MapViewOptions::validate() const
{
  requirePictureSize("width", width);
  if (height)
    requirePictureSize("height", *height);
  const int shorter = std::min(width, height.value_or(width));
  require(margin >= 0 && margin <= shorter / 8, "margin", margin, "0 to an eighth");
  require(shading >= 0 && shading <= 5, "shading", shading, "0 to 5");
  require(point_size > 0 && point_size <= 10, "point_size", point_size, "0 to 10");
  require(max_points > 0, "max_points", max_points, "> 0");
  cut.validate();
}

MapView::MapView(const MapViewOptions& options) : options_(options)
{
  options_.validate();
}

PictureBox
MapView::box() const
{
  const double text = textSizeFor(options_.width);
  const double margin = options_.margin;
  const double height =
      options_.height.value_or(static_cast<int>(kShape * options_.width));
  return {margin,
          margin + 2.2 * text,
          options_.width - margin,
          height - margin - 3.2 * text};
}

ShownPoints
MapView::shownPointsOf(const MapViewScene& scene, Projection projection) const
{
  scene.validate(options_.colour);
  HeightCut cut = options_.cut;
  if (projection == Projection::kPanorama && !cut.max_height)
    cut.max_height = std::numeric_limits<double>::infinity();
  ShownPoints shown = shownPoints(scene.points, scene.trajectory, cut);
  if (shown.indices.empty())
    throw BadArgument("the map has no points to draw");
  return shown;
}

std::vector<Camera>
MapView::viewpoints(const MapViewScene& scene, std::size_t count) const
{
  const auto shown = shownPointsOf(scene, Projection::kPerspective);
  return goodViewpoints(chosen(scene.points, shown.indices), box(), count);
}

Camera
MapView::cameraFrom(const MapViewScene& scene, double azimuth, double elevation) const
{
  const auto shown = shownPointsOf(scene, Projection::kPerspective);
  return cameraOn(chosen(scene.points, shown.indices), azimuth, elevation, box());
}

MapViewPicture
MapView::draw(const MapViewScene& scene, const std::optional<Camera>& camera) const
{
  const Projection projection = camera ? camera->projection : Projection::kPerspective;
  const ShownPoints shown = shownPointsOf(scene, projection);
  MapViewLayout layout;
  layout.map = box();
  layout.height = options_.height.value_or(static_cast<int>(kShape * options_.width));
  layout.camera =
      camera
          ? *camera
          : goodViewpoints(chosen(scene.points, shown.indices), layout.map, 1).front();
  return drawShown(scene, shown, layout);
}

MapViewPicture
MapView::drawPanorama(const MapViewScene& scene,
                      const Eigen::Isometry3d& T_world_scan) const
{
  const ShownPoints shown = shownPointsOf(scene, Projection::kPanorama);
  MapViewLayout layout;
  layout.map = box();
  const Points seen =
      transformed(chosen(scene.points, shown.indices), T_world_scan.inverse());
  layout.camera = panoramaFrom(T_world_scan, seen, layout.map);
  const double below = options_.margin + 3.2 * textSizeFor(options_.width);
  layout.height = options_.height.value_or(
      std::max(200, static_cast<int>(layout.map.bottom + below)));
  layout.map.bottom = std::min(layout.map.bottom, layout.height - below);
  return drawShown(scene, shown, layout);
}

MapViewPicture
MapView::drawShown(const MapViewScene& scene,
                   const ShownPoints& shown,
                   MapViewLayout layout) const
{
  layout.width = options_.width;
  layout.text_size = textSizeFor(options_.width);
  layout.ceiling_hidden = shown.ceiling_hidden;
  const auto indices = thinned(shown.indices, options_.max_points);
  layout.points_drawn = indices.size();
  PointPaint paint = paintPoints(scene,
                                 indices,
                                 {options_.colour,
                                  options_.colour_map,
                                  options_.background,
                                  options_.colour_range});
  layout.lowest_colour = paint.scale.lowest;
  layout.highest_colour = paint.scale.highest;
  PixelScene canvas(
      layout.width, layout.height, themeOf(options_.background).background);
  {
    SplatBuffer splats(layout.width, layout.height);
    addSplats(
        scene.points, indices, layout.camera, layout.map, options_.point_size, splats);
    addModels(scene.models, layout.camera, paint.colours, splats);
    canvas.setBase(splats.paint(paint.colours, options_.shading));
  }
  const Eigen::Isometry3d to_camera = layout.camera.T_world_camera.inverse();
  const Annotations::Project project =
      [&](const Eigen::Vector3d& place) -> std::optional<Eigen::Vector2d> {
    const auto pixel = layout.camera.project(to_camera * place);
    if (!pixel)
      return {};
    return Eigen::Vector2d(pixel->head<2>());
  };
  annotate(options_, scene, layout, paint.scale, project, canvas);
  return {canvas.draw(options_.transparent), layout};
}

} // namespace pcl6d
