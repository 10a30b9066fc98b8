// SPDX-License-Identifier: BSD-3-Clause
#include "top_view_painter.h"

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace pcl6d {

namespace {
using Align = PixelScene::Align;

std::string
number(double value, int decimals)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  return text;
}

std::vector<Eigen::Vector2d>
pathOf(const Trajectory& trajectory, const TopViewLayout& layout)
{
  std::vector<Eigen::Vector2d> path;
  for (const auto& pose : trajectory.poses)
    if (pose.translation().allFinite())
      path.push_back(layout.toPixel(pose.translation().head<2>()));
  return path;
}

} // namespace

TopViewPainter::Theme
TopViewPainter::themeOf(Background background)
{
  if (background == Background::kLight)
    return {{255, 255, 255}, {40, 40, 40}, {240, 120, 20}, {200, 0, 70}};
  return {{12, 13, 18}, {225, 225, 225}, {255, 130, 70}, {255, 255, 255}};
}

TopViewPainter::TopViewPainter(const TopViewOptions& options,
                               const TopViewLayout& layout)
: options_(options)
, layout_(layout)
, theme_(themeOf(options.background))
, scene_(layout.width, layout.height, theme_.background)
{}

void
TopViewPainter::addMap(const DrawnPoints& points)
{
  scene_.addPoints(points.pixels, points.colours, points.size);
}

void
TopViewPainter::addPath(const std::vector<Eigen::Vector2d>& path,
                        const Colour& colour,
                        double layer)
{
  scene_.addLine(path, {theme_.background, scaled(6), layer});
  scene_.addLine(path, {colour, scaled(2.5), layer + 1});
}

void
TopViewPainter::addStartRing(const Eigen::Vector2d& place, const Colour& colour)
{
  scene_.addDisc(place, {theme_.background, scaled(18), 6});
  scene_.addDisc(place, {colour, scaled(14), 7});
  scene_.addDisc(place, {theme_.background, scaled(6), 8});
}

void
TopViewPainter::addTrajectories(const TopViewScene& scene)
{
  const auto initial = pathOf(scene.initial, layout_);
  const auto final = pathOf(scene.trajectory, layout_);
  addPath(initial, theme_.initial, 2);
  addPath(final, theme_.final, 4);
  if (!final.empty())
    addStartRing(final.front(), theme_.final);
  else if (!initial.empty())
    addStartRing(initial.front(), theme_.initial);
}

void
TopViewPainter::addTitle()
{
  if (!options_.title.empty())
    scene_.addText({static_cast<double>(options_.margin),
                    options_.margin + 0.6 * layout_.text_size},
                   options_.title,
                   Align::kLeft,
                   {theme_.text, 1.15 * layout_.text_size});
}

double
TopViewPainter::addLegendText(double right, const std::string& label)
{
  scene_.addText(
      {right, options_.margin + 0.6 * layout_.text_size}, label, Align::kRight, text());
  return right - PixelScene::textWidth(label, layout_.text_size) - scaled(10);
}

double
TopViewPainter::addLegendEntry(double right,
                               const std::string& label,
                               const Colour& colour)
{
  const Eigen::Vector2d end(addLegendText(right, label),
                            options_.margin + 0.6 * layout_.text_size);
  const Eigen::Vector2d begin = end - Eigen::Vector2d(scaled(36), 0);
  scene_.addLine({begin, end}, {colour, scaled(3), 10});
  return begin.x() - scaled(26);
}

void
TopViewPainter::addLegend(const TopViewScene& scene)
{
  double right = layout_.width - options_.margin;
  if (!scene.trajectory.poses.empty())
    right = addLegendEntry(right, options_.final_label, theme_.final);
  if (!scene.initial.poses.empty())
    right = addLegendEntry(right, options_.initial_label, theme_.initial);
  if (scene.trajectory.poses.empty() && scene.initial.poses.empty())
    return;
  const double ring = addLegendText(right, "start") - scaled(8);
  addStartRing({ring, options_.margin + 0.6 * layout_.text_size}, theme_.text);
}

void
TopViewPainter::addScaleBar()
{
  const auto& begin = layout_.scale_bar_begin;
  const auto& end = layout_.scale_bar_end;
  const Eigen::Vector2d tick(0, 0.4 * layout_.text_size);
  scene_.addLine({begin - tick, begin, end, end - tick}, {theme_.text, scaled(2), 10});
  std::ostringstream label;
  label << layout_.scale_bar_metres << " m";
  scene_.addText({0.5 * (begin.x() + end.x()), begin.y() - 1.1 * layout_.text_size},
                 label.str(),
                 Align::kCentre,
                 text());
}

void
TopViewPainter::addColourBar()
{
  const bool by_scan = options_.colour == PointColour::kScan;
  const double span = layout_.highest_colour - layout_.lowest_colour;
  const int decimals = by_scan || span >= 10 ? 0 : 1;
  const std::string low = number(layout_.lowest_colour, decimals);
  const std::string high = number(layout_.highest_colour, decimals);
  const double gap = 0.5 * layout_.text_size;
  const double row = layout_.scale_bar_begin.y() - 0.2 * layout_.text_size;
  const double half_height = 0.35 * layout_.text_size;
  const double length = 0.16 * layout_.width;
  const double right = layout_.width - options_.margin - gap -
                       PixelScene::textWidth(high, layout_.text_size);
  const double left = right - length;

  std::vector<Eigen::Vector3f> pixels;
  std::vector<Colour> colours;
  for (double column = left; column < right; ++column)
    for (double y = row - half_height; y < row + half_height; ++y) {
      pixels.push_back(Eigen::Vector3d(column, y, 10).cast<float>());
      colours.push_back(pointColour((column - left) / length, options_));
    }
  scene_.addPoints(pixels, colours, 2);
  scene_.addText({left - gap, row}, low, Align::kRight, text());
  scene_.addText({right + gap, row}, high, Align::kLeft, text());
  scene_.addText({0.5 * (left + right), row - 1.2 * layout_.text_size},
                 by_scan ? "scan" : "height [m]",
                 Align::kCentre,
                 text());
}

Image
TopViewPainter::draw()
{
  return scene_.draw();
}

PixelScene::Pen
TopViewPainter::text() const
{
  return {theme_.text, layout_.text_size};
}

double
TopViewPainter::scaled(double length) const
{
  return length * std::max(layout_.text_size, 13.0) / 18;
}

} // namespace pcl6d
