// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/annotations.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>

namespace pcl6d::visualization {
namespace {
using Align = PixelScene::Align;

std::optional<Eigen::Vector3d>
firstPlace(const Trajectory& trajectory)
{
  for (const auto& pose : trajectory.poses)
    if (pose.translation().allFinite())
      return Eigen::Vector3d(pose.translation());
  return {};
}

using Align = PixelScene::Align;

std::string
number(double value, int decimals)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.*f", decimals, value);
  return text;
}

int
decimalsFor(const ColourScale& scale)
{
  const double span = scale.highest - scale.lowest;
  if (scale.is_integer || span >= 10 || !(span > 0))
    return 0;
  return span >= 1 ? 1 : span >= 0.1 ? 2 : 3;
}
} // namespace

double
textSizeFor(int width)
{
  return std::clamp(width / 85.0, 10.0, 48.0);
}

Annotations::Annotations(PixelScene& scene,
                         const Frame& frame,
                         Background background,
                         const Project& project)
: scene_(scene), frame_(frame), theme_(themeOf(background)), project_(project)
{}

std::optional<Eigen::Vector2d>
Annotations::pixelOf(const Eigen::Vector3d& place) const
{
  return place.allFinite() ? project_(place) : std::nullopt;
}

/** With a halo, for legibility on points of every colour. */
void
Annotations::addText(const Eigen::Vector2d& place,
                     const std::string& text,
                     PixelScene::Align align,
                     const PixelScene::Pen& pen)
{
  constexpr double kHalo = 1.3; // [px]
  for (const double x : {-kHalo, kHalo})
    for (const double y : {-kHalo, kHalo})
      scene_.addText(
          place + Eigen::Vector2d(x, y), text, align, {theme_.background, pen.size});
  scene_.addText(place, text, align, pen);
}

/** A line that leaves the picture is cut outside the visible area. */
std::vector<PixelScene::Polyline>
Annotations::visibleParts(const std::vector<Eigen::Vector3d>& places) const
{
  std::vector<PixelScene::Polyline> parts(1);
  for (const auto& place : places) {
    const auto pixel = pixelOf(place);
    if (pixel)
      parts.back().push_back(*pixel);
    else if (!parts.back().empty())
      parts.emplace_back();
  }
  return parts;
}

void
Annotations::addPath(const Trajectory& trajectory, const Colour& colour, double layer)
{
  std::vector<Eigen::Vector3d> places;
  for (const auto& pose : trajectory.poses)
    if (pose.translation().allFinite())
      places.emplace_back(pose.translation());
  const auto parts = visibleParts(places);
  scene_.addLines(parts, {theme_.background, scaled(6), layer});
  scene_.addLines(parts, {colour, scaled(2.5), layer + 1});
}

void
Annotations::addStartRing(const Eigen::Vector2d& place, const Colour& colour)
{
  scene_.addDisc(place, {theme_.background, scaled(18), 6});
  scene_.addDisc(place, {colour, scaled(14), 7});
  scene_.addDisc(place, {theme_.background, scaled(6), 8});
}

void
Annotations::addPaths(const Paths& paths)
{
  addPath(paths.initial, theme_.initial, 2);
  addPath(paths.final, theme_.final, 4);
  const auto final = firstPlace(paths.final);
  const auto initial = firstPlace(paths.initial);
  const auto start = final ? final : initial;
  const auto pixel = start ? pixelOf(*start) : std::nullopt;
  if (pixel)
    addStartRing(*pixel, final ? theme_.final : theme_.initial);
}

/** Lines of one pen are drawn in one call, in the order of their first line. */
void
Annotations::addLines(const std::vector<Overlay::Line>& lines)
{
  std::vector<std::pair<PixelScene::Pen, std::vector<PixelScene::Polyline>>> groups;
  std::map<std::pair<Colour, double>, std::size_t> group_of;
  for (const auto& line : lines) {
    const auto [place, is_new] =
        group_of.emplace(std::pair(line.colour, line.width), groups.size());
    if (is_new)
      groups.push_back({{line.colour, scaled(line.width)}, {}});
    auto& group = groups[place->second].second;
    for (auto& part : visibleParts(line.points))
      group.push_back(std::move(part));
  }
  for (std::size_t i = 0; i < groups.size(); ++i) {
    groups[i].first.layer =
        10 + 10 * static_cast<double>(i) / static_cast<double>(groups.size());
    scene_.addLines(groups[i].second, groups[i].first);
  }
}

void
Annotations::addOverlay(const Overlay& overlay)
{
  addLines(overlay.lines);
  std::map<std::pair<Colour, double>, std::vector<Eigen::Vector2d>> discs;
  for (const auto& mark : overlay.marks)
    if (const auto pixel = pixelOf(mark.place))
      discs[{mark.colour, mark.size}].push_back(*pixel);
  for (const auto& [look, places] : discs) {
    scene_.addDiscs(places, {theme_.background, scaled(look.second + 3), 21});
    scene_.addDiscs(places, {look.first, scaled(look.second), 22});
  }
  for (const auto& label : overlay.texts) {
    const auto pixel = pixelOf(label.place);
    if (!pixel)
      continue;
    addText(*pixel, label.text, Align::kCentre, {label.colour, 0.9 * frame_.text_size});
  }
}

void
Annotations::addTitle(const std::string& title)
{
  if (title.empty())
    return;
  const double size = 1.15 * frame_.text_size;
  addText({frame_.margin, topRow()}, title, Align::kLeft, {theme_.text, size});
  title_end_ = frame_.margin + PixelScene::textWidth(title, size);
}

/** Adds the next entry of the legend to the left; beside the title, a row further down.
 * \return the start of its text */
Eigen::Vector2d
Annotations::addLegendText(const std::string& label, double room)
{
  const double width = PixelScene::textWidth(label, frame_.text_size) + room;
  if (legend_end_.x() - width < title_end_ + scaled(20))
    legend_end_ = {frame_.width - frame_.margin,
                   legend_end_.y() + 1.4 * frame_.text_size};
  addText(legend_end_, label, Align::kRight, text());
  const Eigen::Vector2d begin = legend_end_ - Eigen::Vector2d(width - room, 0);
  legend_end_.x() -= width + scaled(26);
  return begin;
}

void
Annotations::addLegendEntry(const std::string& label, const Colour& colour)
{
  const Eigen::Vector2d end =
      addLegendText(label, scaled(46)) - Eigen::Vector2d(scaled(10), 0);
  const Eigen::Vector2d begin = end - Eigen::Vector2d(scaled(36), 0);
  scene_.addLine({begin, end}, {theme_.background, scaled(5), 29});
  scene_.addLine({begin, end}, {colour, scaled(3), 30});
}

void
Annotations::addLegend(const Paths& paths, const std::vector<Overlay::Key>& keys)
{
  legend_end_ = {frame_.width - frame_.margin, topRow()};
  for (auto key = keys.rbegin(); key != keys.rend(); ++key)
    addLegendEntry(key->text, key->colour);
  const bool has_final = !paths.final.poses.empty();
  const bool has_initial = !paths.initial.poses.empty();
  if (has_final && !paths.final_label.empty())
    addLegendEntry(paths.final_label, theme_.final);
  if (has_initial && !paths.initial_label.empty())
    addLegendEntry(paths.initial_label, theme_.initial);
  if (has_final || has_initial)
    addStartRing(addLegendText("start", scaled(30)) - Eigen::Vector2d(scaled(18), 0),
                 theme_.text);
}

PixelScene::Pen
Annotations::text() const
{
  return {theme_.text, frame_.text_size};
}

double
Annotations::topRow() const
{
  return frame_.margin + 0.6 * frame_.text_size;
}

double
Annotations::bottomRow() const
{
  return frame_.height - frame_.margin - 0.6 * frame_.text_size;
}

double
Annotations::scaled(double length) const
{
  return length * std::max(frame_.text_size, 13.0) / 18;
}

void
Annotations::addScaleBar(const Eigen::Vector2d& begin,
                         const Eigen::Vector2d& end,
                         double metres)
{
  const Eigen::Vector2d tick(0, 0.4 * frame_.text_size);
  scene_.addLine({begin - tick, begin, end, end - tick}, {theme_.text, scaled(2), 10});
  std::ostringstream label;
  label << metres << " m";
  addText({0.5 * (begin.x() + end.x()), begin.y() - 1.1 * frame_.text_size},
          label.str(),
          Align::kCentre,
          text());
}

void
Annotations::addColours(const ColourScale& scale)
{
  if (!scale.keys.empty())
    addColourNames(scale);
  else if (!scale.title.empty())
    addColourBar(scale);
}

void
Annotations::addColourNames(const ColourScale& scale)
{
  double right = frame_.width - frame_.margin;
  const double row = bottomRow() - 0.2 * frame_.text_size;
  for (auto key = scale.keys.rbegin(); key != scale.keys.rend(); ++key) {
    addText({right, row}, key->first, Align::kRight, text());
    right -= PixelScene::textWidth(key->first, frame_.text_size) + scaled(16);
    scene_.addDisc({right, row}, {key->second, scaled(14), 10});
    right -= scaled(28);
  }
}

void
Annotations::addColourBar(const ColourScale& scale)
{
  const int decimals = decimalsFor(scale);
  const std::string low = number(scale.lowest, decimals);
  const std::string high = number(scale.highest, decimals);
  const double gap = 0.5 * frame_.text_size;
  const double row = bottomRow() - 0.2 * frame_.text_size;
  const double half_height = 0.35 * frame_.text_size;
  const double length = 0.16 * frame_.width;
  const double right = frame_.width - frame_.margin - gap -
                       PixelScene::textWidth(high, frame_.text_size);
  const double left = right - length;

  std::vector<Eigen::Vector3f> pixels;
  std::vector<Colour> colours;
  for (double column = left; column < right; ++column)
    for (double y = row - half_height; y < row + half_height; ++y) {
      pixels.push_back(Eigen::Vector3d(column, y, 1).cast<float>());
      colours.push_back(scale.colourOf((column - left) / length));
    }
  scene_.addPoints(pixels, colours, 2);
  addText({left - gap, row}, low, Align::kRight, text());
  addText({right + gap, row}, high, Align::kLeft, text());
  addText({0.5 * (left + right), row - 1.2 * frame_.text_size},
          scale.title,
          Align::kCentre,
          text());
}

} // namespace pcl6d::visualization
