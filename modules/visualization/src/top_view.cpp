// SPDX-License-Identifier: BSD-3-Clause
#include "height_cut.h"
#include "picture_size.h"
#include "top_view_layout.h"
#include "top_view_painter.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/visualization/top_view.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace pcl6d {

namespace {
void
checkScene(const TopViewScene& scene, PointColour colour)
{
  const bool by_scan = colour == PointColour::kScan;
  if ((by_scan || !scene.scans.empty()) && scene.scans.size() != scene.points.size())
    throw BadArgument(std::to_string(scene.scans.size()) + " scan indices for " +
                      std::to_string(scene.points.size()) + " points");
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
  if (max_height)
    require(!std::isnan(*max_height), "max_height", *max_height, "a number");
  require(std::isfinite(cut_above_trajectory),
          "cut_above_trajectory",
          cut_above_trajectory,
          "finite");
}

TopView::TopView(const TopViewOptions& options) : options_(options)
{
  options_.validate();
}

TopViewPicture
TopView::draw(const TopViewScene& scene) const
{
  checkScene(scene, options_.colour);
  const ShownPoints shown = shownPoints(scene, options_);
  if (shown.indices.empty())
    throw BadArgument("the map has no points to draw");
  Points points;
  points.reserve(shown.indices.size());
  for (const auto i : shown.indices)
    points.push_back(scene.points[i]);
  TopViewPicture picture;
  picture.layout = layOut(points, scene, options_);
  picture.layout.ceiling_hidden = shown.ceiling_hidden;
  const auto drawn = drawnPoints(scene, shown, options_, picture.layout);
  TopViewPainter painter(options_, picture.layout);
  painter.addMap(drawn);
  painter.addTrajectories(scene);
  painter.addTitle();
  painter.addLegend(scene);
  painter.addScaleBar();
  painter.addColourBar();
  picture.image = painter.draw();
  return picture;
}

TopViewLayout
TopView::write(const std::filesystem::path& path, const TopViewScene& scene) const
{
  const TopViewPicture picture = draw(scene);
  writePng(path, picture.image);
  return picture.layout;
}

} // namespace pcl6d
