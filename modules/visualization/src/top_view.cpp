// SPDX-License-Identifier: BSD-3-Clause
#include "annotations.h"
#include "picture_size.h"
#include "top_view_layout.h"
#include "top_view_points.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/visualization/top_view.h>

#include <algorithm>

namespace pcl6d {

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
  annotate(scene, drawn.scale, layout, canvas);
  picture.image = canvas.draw(options_.transparent);
  return picture;
}

void
TopView::annotate(const TopViewScene& scene,
                  const ColourScale& scale,
                  const TopViewLayout& layout,
                  PixelScene& canvas) const
{
  const Annotations::Project project = [&](const Eigen::Vector3d& place) {
    return std::optional<Eigen::Vector2d>(layout.toPixel(place.head<2>()));
  };
  const Annotations::Frame frame = {layout.width,
                                    layout.height,
                                    static_cast<double>(options_.margin),
                                    layout.text_size};
  static const Trajectory kNone;
  const Annotations::Paths paths = {options_.draw_paths ? scene.initial : kNone,
                                    options_.draw_paths ? scene.trajectory : kNone,
                                    options_.initial_label,
                                    options_.final_label};
  Annotations annotations(canvas, frame, options_.background, project);
  annotations.addPaths(paths);
  annotations.addOverlay(scene.overlay);
  annotations.addTitle(options_.title);
  annotations.addLegend(paths, scene.overlay);
  annotations.addScaleBar(
      layout.scale_bar_begin, layout.scale_bar_end, layout.scale_bar_metres);
  annotations.addColours(scale);
}

TopViewLayout
TopView::write(const std::filesystem::path& path, const TopViewScene& scene) const
{
  const TopViewPicture picture = draw(scene);
  writePng(path, picture.image);
  return picture.layout;
}

} // namespace pcl6d
