// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/colours.h"
#include "drawing/pixel_scene.h"
#include "drawing/round_numbers.h"
#include "drawing/theme.h"

#include <pcl6d/common/require.h>
#include <pcl6d/visualization/convergence_map.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl6d {
using namespace visualization;

namespace {
constexpr int kMapLargest = 8192; // [px]
constexpr double kMapTextSize = 15;
constexpr double kMapMargin = 24;
constexpr double kMapAxisRoom = 4.2 * kMapTextSize;  ///< left of the first column
constexpr double kMapTickRoom = 1.5 * kMapTextSize;  ///< below a panel
constexpr double kMapTitleRoom = 1.9 * kMapTextSize; ///< above a panel
constexpr double kMapGap = 1.4 * kMapTextSize;       ///< between columns
constexpr double kMapHeadRoom = 2.0 * kMapTextSize;  ///< for the title of the picture
constexpr double kMapFootRoom = 3.4 * kMapTextSize;  ///< for x [m] and the colour bar

/** Up to five in a row; more panels fill a rectangle wider than high. */
int
columnsFor(int panels)
{
  constexpr int kOneRow = 5;
  if (panels <= kOneRow)
    return panels;
  return static_cast<int>(std::ceil(std::sqrt(1.6 * panels)));
}

/** \return the distance of adjacent values; 1 for a single value */
double
spacingOf(const std::vector<double>& values)
{
  const std::size_t count = values.size();
  return count > 1 ? (values.back() - values.front()) / static_cast<double>(count - 1)
                   : 1.0;
}

double
extentOf(const std::vector<double>& values)
{
  return values.back() - values.front() + spacingOf(values);
}

/** \brief Places panels, axes and colour bar. \throws BadArgument too large a picture */
ConvergenceMapLayout
layOut(const ConvergenceMapScene& scene, const ConvergenceMapOptions& options)
{
  const int count = static_cast<int>(scene.panels.size());
  ConvergenceMapLayout layout;
  layout.text_size = kMapTextSize;
  layout.columns =
      options.columns > 0 ? std::min(options.columns, count) : columnsFor(count);
  const int rows = (count + layout.columns - 1) / layout.columns;
  layout.low = {scene.x.front() - 0.5 * spacingOf(scene.x),
                scene.y.front() - 0.5 * spacingOf(scene.y)};
  layout.metres_per_pixel = extentOf(scene.x) / options.panel_width;
  const double panel_height = std::round(extentOf(scene.y) / layout.metres_per_pixel);
  const double row_height = kMapTitleRoom + panel_height + kMapTickRoom;
  const double top = kMapMargin + kMapHeadRoom;
  const double width = 2 * kMapMargin + kMapAxisRoom +
                       layout.columns * (options.panel_width + kMapGap) - kMapGap;
  // for the title; real text is a little wider than its computed width
  const double least_width =
      2 * kMapMargin + 1.05 * PixelScene::textWidth(scene.title, 1.15 * kMapTextSize);
  const double height = top + rows * row_height + kMapFootRoom + kMapMargin;
  layout.width = static_cast<int>(std::ceil(std::max({width, least_width, 480.0})));
  layout.height = static_cast<int>(std::ceil(height));
  require(layout.width <= kMapLargest && height <= kMapLargest,
          "size of the picture",
          std::to_string(layout.width) + " x " + std::to_string(height),
          "at most 8192 pixels; take fewer columns or smaller panels");
  for (int i = 0; i < count; ++i) {
    PictureBox box;
    box.left = std::round(kMapMargin + kMapAxisRoom +
                          (i % layout.columns) * (options.panel_width + kMapGap));
    box.top = std::round(top + (i / layout.columns) * row_height + kMapTitleRoom);
    box.right = box.left + options.panel_width;
    box.bottom = box.top + panel_height;
    layout.panels.push_back(box);
  }
  layout.colour_bar.right = layout.width - kMapMargin - 3.0 * kMapTextSize;
  layout.colour_bar.left = layout.colour_bar.right - 160;
  layout.colour_bar.bottom = std::round(layout.height - kMapMargin);
  layout.colour_bar.top = layout.colour_bar.bottom - std::round(0.8 * kMapTextSize);
  return layout;
}

using Align = PixelScene::Align;

void
checkOffsets(const char* name, const std::vector<double>& values)
{
  require(!values.empty(), name, "none", "one offset at least");
  for (std::size_t i = 0; i < values.size(); ++i)
    require(std::isfinite(values[i]) && (i == 0 || values[i] > values[i - 1]),
            name,
            values[i],
            "finite and ascending");
}

void
checkScene(const ConvergenceMapScene& scene)
{
  checkOffsets("x", scene.x);
  checkOffsets("y", scene.y);
  require(!scene.panels.empty(), "panels", "none", "one at least");
  for (const auto& panel : scene.panels) {
    require(panel.shares.size() == scene.x.size() * scene.y.size(),
            "shares of a panel",
            panel.shares.size(),
            "the number of places of the grid");
    for (const double share : panel.shares)
      require(std::isnan(share) || (share >= 0 && share <= 1),
              "share",
              share,
              "in [0, 1] or NaN");
  }
}

std::string
label(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", std::abs(value) < 1e-12 ? 0.0 : value);
  return text;
}

/** Draws one map; each method adds a part. */
class Painter {
public:
  Painter(const ConvergenceMapScene& scene,
          const ConvergenceMapLayout& layout,
          Background background)
  : map_(scene)
  , layout_(layout)
  , text_(themeOf(background).text)
  , scene_(layout.width, layout.height, themeOf(background).background)
  {}

  Image
  paint()
  {
    const double half = 0.5 * layout_.text_size;
    scene_.addText({layout_.panels.front().left - 4 * layout_.text_size, 24 + half},
                   map_.title,
                   Align::kLeft,
                   {text_, 1.15 * layout_.text_size});
    for (std::size_t i = 0; i < map_.panels.size(); ++i) {
      addCells(i);
      const Eigen::Vector2d best = layout_.toPixel(i, {0, 0});
      if (layout_.panels[i].contains(best))
        addRing(best);
      addXAxis(i);
      addYAxis(i);
    }
    addColourBar();
    addRingLegend();
    scene_.addPoints(pixels_, colours_, 1);
    return scene_.draw();
  }

private:
  void
  addCells(std::size_t panel)
  {
    const PictureBox& box = layout_.panels[panel];
    const double cell = spacingOf(map_.x) / layout_.metres_per_pixel;
    const double rim = cell >= 8 ? 1 : 0; // makes single cells visible
    for (double row = box.top; row < box.bottom; ++row)
      for (double column = box.left; column < box.right; ++column) {
        const double along = (column - box.left) / cell;
        const double up = (box.bottom - 1 - row) / cell;
        const auto i = std::min(static_cast<std::size_t>(along), map_.x.size() - 1);
        const auto j = std::min(static_cast<std::size_t>(up), map_.y.size() - 1);
        if ((along - static_cast<double>(i)) * cell < rim ||
            (up - static_cast<double>(j)) * cell < rim)
          continue;
        addPixel(
            column, row, colourOf(map_.panels[panel].shares[j * map_.x.size() + i]));
      }
  }

  static Colour
  colourOf(double share)
  {
    return std::isnan(share) ? Colour{170, 170, 170} : heightColour(share);
  }

  void
  addPixel(double column, double row, const Colour& colour)
  {
    pixels_.push_back(Eigen::Vector3d(column + 0.5, row + 0.5, 0.5).cast<float>());
    colours_.push_back(colour);
  }

  void
  addRing(const Eigen::Vector2d& place)
  {
    scene_.addDisc(place, {{0, 0, 0}, 13, 5});
    scene_.addDisc(place, {{255, 255, 255}, 10, 6});
    scene_.addDisc(place, {{0, 0, 0}, 4, 7});
  }

  void
  addXAxis(std::size_t panel)
  {
    const PictureBox& box = layout_.panels[panel];
    const double size = layout_.text_size;
    scene_.addText({box.left, box.top - 0.75 * size},
                   map_.panels[panel].title,
                   Align::kLeft,
                   {text_, size});
    const double low = layout_.low.x();
    const double high = low + layout_.metres_per_pixel * (box.right - box.left);
    for (const double x : roundTicks(low, high)) {
      const double column = layout_.toPixel(panel, {x, 0}).x();
      tick({column, box.bottom}, {column, box.bottom + 4});
      scene_.addText(
          {column, box.bottom + 0.9 * size}, label(x), Align::kCentre, small());
    }
    const bool last_row = panel + columns() >= map_.panels.size();
    if (last_row)
      scene_.addText({0.5 * (box.left + box.right), box.bottom + 2.1 * size},
                     "x [m]",
                     Align::kCentre,
                     small());
  }

  void
  addYAxis(std::size_t panel)
  {
    const PictureBox& box = layout_.panels[panel];
    const double right = box.left - 0.6 * layout_.text_size;
    const bool first_column = panel % columns() == 0;
    const double low = layout_.low.y();
    const double high = low + layout_.metres_per_pixel * (box.bottom - box.top);
    for (const double y : roundTicks(low, high)) {
      const double row = layout_.toPixel(panel, {0, y}).y();
      tick({box.left, row}, {box.left - 4, row});
      if (first_column)
        scene_.addText({right, row}, label(y), Align::kRight, small());
    }
    if (first_column)
      scene_.addText(
          {right, box.top - 0.75 * layout_.text_size}, "y [m]", Align::kRight, small());
  }

  std::size_t
  columns() const
  {
    return static_cast<std::size_t>(layout_.columns);
  }

  void
  tick(const Eigen::Vector2d& from, const Eigen::Vector2d& to)
  {
    scene_.addLine({from, to}, {text_, 1, 3});
  }

  void
  addColourBar()
  {
    const PictureBox& bar = layout_.colour_bar;
    const double row = 0.5 * (bar.top + bar.bottom), gap = 0.4 * layout_.text_size;
    for (double y = bar.top; y < bar.bottom; ++y)
      for (double x = bar.left; x < bar.right; ++x)
        addPixel(x, y, colourOf((x - bar.left) / (bar.right - 1 - bar.left)));
    scene_.addText({bar.right + gap, row}, "100 %", Align::kLeft, small());
    scene_.addText(
        {bar.left - gap, row}, map_.share_label + "  0 %", Align::kRight, small());
  }

  void
  addRingLegend()
  {
    const PictureBox& bar = layout_.colour_bar;
    const Eigen::Vector2d place(layout_.panels.front().left + 7,
                                0.5 * (bar.top + bar.bottom));
    addRing(place);
    scene_.addText(
        {place.x() + layout_.text_size, place.y()}, "best pose", Align::kLeft, small());
  }

  PixelScene::Pen
  small() const
  {
    return {text_, 0.85 * layout_.text_size};
  }

  const ConvergenceMapScene& map_;
  const ConvergenceMapLayout& layout_;
  Colour text_;
  PixelScene scene_;
  std::vector<Eigen::Vector3f> pixels_;
  std::vector<Colour> colours_;
};
} // namespace

void
ConvergenceMapOptions::validate() const
{
  require(panel_width >= 100 && panel_width <= 2000,
          "panel_width",
          panel_width,
          "100 to 2000");
  require(columns >= 0, "columns", columns, ">= 0");
}

ConvergenceMap::ConvergenceMap(const ConvergenceMapOptions& options) : options_(options)
{
  options_.validate();
}

ConvergenceMapPicture
ConvergenceMap::draw(const ConvergenceMapScene& scene) const
{
  checkScene(scene);
  ConvergenceMapPicture picture;
  picture.layout = layOut(scene, options_);
  picture.image = Painter(scene, picture.layout, options_.background).paint();
  return picture;
}

ConvergenceMapLayout
ConvergenceMap::write(const std::filesystem::path& path,
                      const ConvergenceMapScene& scene) const
{
  const ConvergenceMapPicture picture = draw(scene);
  writePng(path, picture.image);
  return picture.layout;
}

} // namespace pcl6d
